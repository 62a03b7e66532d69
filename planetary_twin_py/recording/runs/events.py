"""Events in the runs of a recording."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any, NamedTuple

from ...model.clock import TICKS
from ..ros2.topics import STATE
from .schedule import messages_of


class Event(NamedTuple):
    """An event in the interval that starts at simulated time `time` [s]."""

    time: float
    run: int
    """Number of the run, from 1, incremented at each reset; 0 before the first recorded start."""
    text: str


def events_of_all(path: Path, topics: Iterable[str]) -> list[tuple[str, Event]]:
    """Events of each gearbox in a recording, with its namespace.

    Raises:
        RecordingError: `path` is not a recording.
    """
    suffix = f"/{STATE}"
    names = (topic.removesuffix(suffix) for topic in topics if topic.endswith(suffix))
    return [(name, event) for name in sorted(names) for event in read_events(path, name, [])]


def read_events(path: Path, namespace: str, remarks: list[str]) -> Iterator[Event]:
    """Read starts, resets, missing messages, changed settings, and loss of contact.

    Raises:
        RecordingError: `path` is not a recording.
    """
    run, before = 0, None
    for _, state in messages_of(path, namespace, (STATE,), remarks):
        begin = (round(state.simulated_time * TICKS) - round(state.interval * TICKS)) / TICKS
        started = begin == 0.0
        run += started
        missing = 0 if before is None else state.sequence - before.sequence - 1
        if missing > 0:
            yield Event(begin, run, f"{missing} messages of {STATE} are missing before")
        if started:
            yield Event(begin, run, "start" if run == 1 else "start after a reset")
        for text in _changes(None if started else before, state):
            yield Event(begin, run, text)
        before = state


def _changes(before: Any, state: Any) -> Iterator[str]:
    """Differences of an interval from the previous one of its run."""
    for name, text in (("tolerance", "tolerance = {:g}"), ("sample_rate", "waveform at {:g} Hz")):
        now = getattr(state, name)
        measured = math.isnan(now)  # only simulated intervals have these settings
        if not measured and (before is None or now != getattr(before, name)):
            yield text.format(now)
    separated, already = _parted(state), [] if before is None else _parted(before)
    if separated and not already:
        yield f"teeth separate in {', '.join(separated)}"
    if already and not separated:
        yield "teeth remain in contact in every mesh"


def _parted(state: Any) -> list[str]:
    """Meshes whose teeth were separated in part of an interval."""
    return [
        f"{kind}_{n + 1}"
        for kind in ("sun_planet", "planet_ring")
        for n, share in enumerate(getattr(state, f"{kind}_contact_fraction")[: state.planets])
        if share < 1.0
    ]
