"""How far a live twin has come."""

from __future__ import annotations

from enum import StrEnum
from typing import NamedTuple


class State(StrEnum):
    """State of simulated time."""

    RUNNING = "running"
    PAUSED = "paused"
    WAITING = "waits"
    FAILED = "failed"


class Progress(NamedTuple):
    """Times and counters of a live twin at the end of an interval."""

    simulated: float  # [s]
    wall: float  # [s] steady clock
    ran: float  # [s] simulated time of all intervals; steps of a paused twin do not count
    lasted: float  # [s] wall time of these intervals; pauses do not count
    cpu: float  # [s] processor time of the thread, without steps of a paused twin
    overruns: int
    repeats: bool  # steady running: mesh cycles are repeated, not computed
    state: State
    failure: str = ""  # reason of the state FAILED
    held: float = 0.0  # [s] wall time for which the twin has waited for its recorder
