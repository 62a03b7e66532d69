"""Which gearbox of a recording is meant."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from ..container.records import RecordingError
from .topics import STATE


def choose_namespace(topics: Iterable[str], wanted: str | None, path: str | Path) -> str:
    """The namespace `wanted` among those of `topics`; without one, the only one there is.

    Raises:
        RecordingError: there is none, another, or more than one.
    """
    found = sorted(topic[: -len(STATE) - 1] for topic in topics if topic.endswith("/" + STATE))
    if not found:
        raise RecordingError(f"{path}: no {STATE} message in it, so there is nothing to show")
    if wanted is None:
        if len(found) > 1:
            raise RecordingError(
                f"{path}: holds several gearboxes, choose --namespace from {', '.join(found)}"
            )
        return found[0]
    wanted = "/" + wanted.strip("/") if wanted.strip("/") else ""
    if wanted not in found:
        raise RecordingError(f"namespace = {wanted}: {path} holds {', '.join(found)}")
    return wanted
