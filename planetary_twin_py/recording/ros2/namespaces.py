"""Selects one of several gearboxes in a recording."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from ..container.records import RecordingError
from .topics import STATE


def choose_namespace(topics: Iterable[str], wanted: str | None, path: str | Path) -> str:
    """Select the namespace of a gearbox.

    Args:
        topics: names of all topics.
        wanted: namespace; None selects the only one.
        path: of the recording, for error messages.

    Returns:
        The namespace.

    Raises:
        RecordingError: there is no gearbox, not the wanted one, or more than one.
    """
    found = sorted(topic[: -len(STATE) - 1] for topic in topics if topic.endswith("/" + STATE))
    if not found:
        raise RecordingError(f"{path}: has no {STATE} messages, so it is not of a gearbox")
    if wanted is None:
        if len(found) > 1:
            raise RecordingError(
                f"{path}: has several gearboxes, choose --namespace from {', '.join(found)}"
            )
        return found[0]
    wanted = "/" + wanted.strip("/") if wanted.strip("/") else ""
    if wanted not in found:
        raise RecordingError(f"namespace = {wanted}: {path} has {', '.join(found)}")
    return wanted
