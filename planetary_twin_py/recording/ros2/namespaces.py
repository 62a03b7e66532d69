"""Selects one of several gearboxes in a recording."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from ..container.records import RecordingError
from .no_run import no_run_yet
from .playback import Playback
from .topics import STATE


def namespace_in(path: Path, wanted: str | None = None) -> str:
    """Select the namespace of a gearbox in a recording, see `choose_namespace`."""
    return choose_namespace(Playback(path).counts, wanted, path)


def choose_namespace(counts: Mapping[str, int], wanted: str | None, path: str | Path) -> str:
    """Select the namespace of a gearbox.

    Args:
        counts: numbers of messages by topic.
        wanted: namespace; None selects the only one.
        path: path of the recording, for error messages.

    Raises:
        RecordingError: there is no gearbox, not the wanted one, or more than one.
    """
    states = [name for name, count in counts.items() if count and name.endswith("/" + STATE)]
    namespaces = sorted(name[: -len(STATE) - 1] for name in states)
    if not namespaces:
        no_run = no_run_yet(Path(path), counts)
        raise RecordingError(
            no_run or f"{path}: has no {STATE} messages, so it is not of a gearbox"
        )
    if wanted is None:
        if len(namespaces) > 1:
            raise RecordingError(
                f"{path}: has several gearboxes, choose --namespace from {', '.join(namespaces)}"
            )
        return namespaces[0]
    wanted = "/" + wanted.strip("/") if wanted.strip("/") else ""
    if wanted not in namespaces:
        raise RecordingError(f"namespace = {wanted}: {path} has {', '.join(namespaces)}")
    return wanted
