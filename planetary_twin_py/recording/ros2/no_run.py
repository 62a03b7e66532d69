"""Recognises a recording that was cut off before its run began, or whose run is damaged."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

from ..container.integrity import damaged_data, end_of_data
from ..container.records import files_of
from .definitions import KINDS, OF_PORTS
from .topics import ORIGIN, STATE

_OF_A_TWIN = {*KINDS, *OF_PORTS, "tf", "diagnostics"}
_OF_A_FOLLOWER = "estimate"  # a topic beside measured joint_states


def no_run_yet(path: Path, counts: Mapping[str, int]) -> str | None:
    """Return a line if a recording of a twin lacks its states or the origin of its run.

    Either the recording was cut off, and so has no end, or what it lacks was lost in damage.

    Args:
        path: path of the recording.
        counts: numbers of messages by topic; 0 for a topic without messages.

    Returns:
        What is missing and what to do; None if nothing is missing, if the recording is finished and
        undamaged, or if it is of something else than a twin.
    """
    known = {name.rpartition("/")[2] for name in counts}
    with_messages = {name.rpartition("/")[2] for name, count in counts.items() if count}
    missing = [name for name in (ORIGIN, STATE) if name not in with_messages]
    if STATE in with_messages and ORIGIN not in known:  # of a version without it
        return None
    of_a_twin = STATE in known or (with_messages <= _OF_A_TWIN and _OF_A_FOLLOWER not in known)
    if not (missing and of_a_twin):
        return None
    files = files_of(path)
    if STATE in with_messages or all(end_of_data(file) is not None for file in files):
        return _lost(path, missing) if any(map(damaged_data, files)) else None
    return (
        f"{path}: holds no run yet: it ends before the first {' and '.join(missing)}; if it is "
        "still being written, try again later; if its recorder was killed, record again"
    )


def _lost(path: Path, missing: Sequence[str]) -> str:
    """What was lost of a run, and what follows."""
    if STATE in missing:
        return f"{path}: its run was lost in the damage: no {' and '.join(missing)} can be read"
    return (
        f"{path}: the origin of its run ({ORIGIN}) was lost in the damage, so its states cannot be "
        "verified"
    )
