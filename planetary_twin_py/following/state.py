"""The estimated state of a gearbox."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field

from .balance.balances import Innovation
from .estimate import Estimate, Event
from .teeth.baseline import LearnedCell
from .teeth.changed import ToothState


@dataclass(frozen=True)
class Following:
    """Estimated state of a gearbox at one time."""

    time: float
    """Stamp of the last reading that is used [s]; NaN before the first."""
    estimates: tuple[Estimate, ...]
    """Estimates of all quantities, each with its interval or status."""
    teeth: tuple[ToothState, ...] = ()
    """Teeth that have changed."""
    events: tuple[Event, ...] = ()
    """Changes, in the order of their detection."""
    counters: dict[str, int] = field(default_factory=dict)
    """Numbers of readings and samples that were not used, by reason, and of hunting periods."""
    remarks: tuple[str, ...] = ()
    """Reasons why the estimates are less certain than their intervals."""
    operating: tuple[float, float] = (math.nan, math.nan)
    """Speed of the input [rad/s], NaN before one is measured, and oil temperature [K]."""
    innovation: Innovation | None = None
    """Innovation of the last bin; None before a bin has both torques and a speed."""
    scatter: float = 1.0
    """Standard deviation of innovations over that of the sensors' noise, at least 1."""
    every_z: tuple[float, ...] = ()
    """Standard deviations with which every tooth stands out in the last hunting period: sun, each
    planet, ring; empty while a baseline is being learned."""
    cells: tuple[LearnedCell, ...] = ()
    """Learning state of the baselines, by operating cell."""
    judged: Mapping[str, bool] = field(default_factory=dict)
    """Whether a change could have been found, by what is measured, such as "torque balance" and
    "teeth"; the remarks say why not."""

    @property
    def unchanged(self) -> str:
        """What it means that there are no events."""
        judged = [f"the {name}" for name, known in self.judged.items() if known]
        others = [name for name, known in self.judged.items() if not known]
        if not others:
            return "no change found"
        if judged:
            return f"no change in {' and '.join(judged)}; not judged: {', '.join(others)}"
        if len(others) == 1:
            return "changes cannot be found without both torques and a speed while the train turns"
        return f"not judged: {', '.join(others)}"

    def __getitem__(self, name: str) -> Estimate:
        """Return the estimate of the quantity `name`."""
        return next(estimate for estimate in self.estimates if estimate.name == name)
