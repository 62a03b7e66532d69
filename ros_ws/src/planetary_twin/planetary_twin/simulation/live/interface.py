"""Interface of a live twin: the node, its progress, and commands at its ports."""

from __future__ import annotations

from enum import StrEnum
from typing import NamedTuple, Protocol

from planetary_twin_py import Twin, Window
from planetary_twin_py.run.quality_control import QualityControl, Setting


class TwinNode(Protocol):
    """Callbacks of a live twin, in its thread, or in that of a command while it halts."""

    def computed(self, window: Window) -> None:
        """Receive a computed interval before the wall time of its end."""

    def refused(self, reason: str) -> None:
        """Receive the reason why a ramp ended early, or why a command had no effect."""

    def retuned(self, instant: float, before: Setting, quality: QualityControl) -> None:
        """From simulated time `instant` [s], the setting of `quality` replaces `before`."""

    def ready(self) -> bool:
        """Return whether time can pass: for example, the clock to follow is available."""

    def has_room(self) -> bool:
        """Return whether the recorder has kept up and the next interval may be published."""

    def stopped(self, defect: Exception) -> None:
        """Receive the exception that ended the thread."""


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


class PortCommands(Protocol):
    """Commands at the ports of a twin, used by one thread at a time."""

    def collect(self) -> None:
        """Take the commands that have arrived, also while the twin halts."""

    def given(self, twin: Twin, interval: float) -> dict[str, float]:
        """
        Return the commands for the next `interval` [s], as arguments of `Twin.advance`.

        For a step of a paused twin, the interval is 0. If commands are missing, the twin may be
        braked.
        """

    def refuse(self, reason: str) -> None:
        """Count commands that the twin has refused."""

    def release(self, twin: Twin) -> None:
        """End a brake, which has changed the ports."""
