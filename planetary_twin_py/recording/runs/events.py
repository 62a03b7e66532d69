"""What happened in the runs of a recording, interval by interval."""

from __future__ import annotations

import math
from collections.abc import Iterator
from pathlib import Path
from typing import Any, NamedTuple

from ...twin import TICKS
from ..ros2.topics import STATE
from .schedule import messages_of


class Event(NamedTuple):
    """What is so from a simulated instant [s] on, or from somewhere in the interval after it."""

    time: float
    run: int
    """Counted from 1: each reset begins another; 0 before the first start that is recorded."""
    text: str


def read_events(path: Path, namespace: str, remarks: list[str]) -> Iterator[Event]:
    """Starts, resets, missing messages, other settings, and contact that is lost and kept again.

    Raises:
        RecordingError: there is no recording.
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
            yield Event(begin, run, "starts" if run == 1 else "starts again, after a reset")
        for text in _news(None if started else before, state):
            yield Event(begin, run, text)
        before = state


def _news(before: Any, state: Any) -> Iterator[str]:
    """In what an interval differs from the one before in its run."""
    for name, text in (("tolerance", "tolerance = {:g}"), ("sample_rate", "waveform at {:g} Hz")):
        now = getattr(state, name)
        measured = math.isnan(now)  # and not simulated, so that it has none
        if not measured and (before is None or now != getattr(before, name)):
            yield text.format(now)
    lost, already = _parted(state), [] if before is None else _parted(before)
    if lost and not already:
        yield f"contact is lost for a time at {', '.join(lost)}"
    if already and not lost:
        yield "contact is kept at every mesh"


def _parted(state: Any) -> list[str]:
    """Meshes whose teeth were apart for some of an interval."""
    return [
        f"{kind}_{n + 1}"
        for kind in ("sun_planet", "planet_ring")
        for n, share in enumerate(getattr(state, f"{kind}_contact_fraction")[: state.planets])
        if share < 1.0
    ]
