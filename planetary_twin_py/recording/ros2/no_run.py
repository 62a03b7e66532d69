"""Recognises a recording that was cut off before its run began."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from ..container.integrity import damaged_summary
from ..container.records import files_of
from .definitions import KINDS, OF_PORTS
from .topics import ORIGIN, STATE

_OF_A_TWIN = {*KINDS, *OF_PORTS, "tf", "diagnostics"}


def no_run_yet(path: Path, counts: Mapping[str, int]) -> str | None:
    """Return a line if a recording of a twin has no end, and no state or no origin of its run.

    Args:
        path: path of the recording.
        counts: numbers of messages by topic; 0 for a topic without messages.

    Returns:
        What is missing and what to do; None if nothing is missing, if the recording is finished, or
        if it is of something else than a twin.
    """
    known = {name.rpartition("/")[2] for name in counts}
    with_messages = {name.rpartition("/")[2] for name, count in counts.items() if count}
    missing = [name for name in (ORIGIN, STATE) if name not in with_messages]
    if STATE in with_messages and ORIGIN not in known:  # of a version without it
        return None
    of_a_twin = STATE in known or with_messages <= _OF_A_TWIN
    if not (missing and of_a_twin and any(damaged_summary(file) for file in files_of(path))):
        return None
    return (
        f"{path}: holds no run yet: it ends before the first {' and '.join(missing)}; if it is "
        "still being written, try again later; if its recorder was killed, record again"
    )
