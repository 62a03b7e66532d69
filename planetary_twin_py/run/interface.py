"""What `Twin` and `simulate` ask of a run in progress, dynamic or quasi-static."""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from types import MappingProxyType
from typing import Protocol

from .._core import Control, Passages, Report, Train, WindowEnd
from ..model.gearbox import Gearbox
from ..scene import OperatingPoint
from .samples import Samples, Waves
from .warming import Warming
from .window_jobs import WindowJobs

NO_CHANGE: Mapping[str, float] = MappingProxyType({})
"""No other severities."""


class Run(Protocol):
    """A model that is advanced in time."""

    gearbox: Gearbox
    """Of the scene; its operating point and ports may have changed since."""
    train: Train
    warming: Warming | None
    """Temperatures; None if the scene gives that of the oil."""
    start_warning: str
    """Why the start is no equilibrium, "" if it is one."""

    @property
    def reached(self) -> Fraction:
        """End of the ledger [s], at or after the end of the last window."""

    @property
    def control(self) -> Control:
        """Counters of steps and events, see `core/integrators/control.hpp`."""

    @property
    def passages(self) -> Passages:
        """Peaks of the tooth pairs in mesh and turning points of the torques of shafts so far."""

    @property
    def repeats(self) -> bool:
        """Whether the motion is periodic, so that mesh cycles are not computed again."""

    def window(
        self, until: int, first: int, rate: float, report: Report, out: Waves, end: WindowEnd
    ) -> WindowJobs:
        """Simulate until `until` [ticks of the clock]; fill what `out` asks for, and the end.

        Sample `first` and all others are integer multiples of 1/rate. Energy ledger and mesh sums
        of `end` are those since the last window. The work is done as the jobs are.
        """

    def begin_window(self, time: int, end: WindowEnd) -> None:
        """Begin a window at `time` [ticks of the clock], the end of the last one."""

    def exact_end(self, time: int, end: WindowEnd) -> None:
        """Fill `end` as if the last step ended at `time` [ticks], the end of the last window.

        Its ledger is that since this window. The run itself is not changed.
        """

    def sample(self, time: float | Fraction) -> Samples:
        """One sample at `time` [s], the end of the last window."""

    @property
    def severities(self) -> Mapping[str, float]:
        """Present severities of the faults by dotted name."""

    def change(
        self,
        point: OperatingPoint,
        tolerance: float,
        time: float | Fraction,
        severities: Mapping[str, float] = NO_CHANGE,
    ) -> None:
        """Change operating point, tolerance and severities at `time` [s], the end of a window."""
