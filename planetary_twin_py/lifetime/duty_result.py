"""Damage of a duty and lives: results."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..text.object_repr import brief
from .ageing import left_until_one
from .excerpts import MapError
from .load_distribution import LoadDistribution
from .remaining_life import RemainingLife
from .sensitivity import Sensitivity
from .steady_damage import Unsteady

Array = NDArray[np.float64]


class Equivalent(NamedTuple):
    """A constant torque that damages a part as much as the duty."""

    part: str
    """The tooth or bearing with the largest damage; "" without damage."""
    torque: float
    """[N m]; NaN without an exponent."""
    exponent: float
    """m: damage over torque in this duty is proportional to torque^m; NaN if 2 % less does none."""
    turns: float
    """n_eq: turns of the input in the whole time, all under this torque."""
    application_factor: float
    """K_A: this torque over that of the scene; NaN if that is 0."""


class DutyLife(NamedTuple):
    """Damage of a duty and the lives that follow; nothing here is a rating to a standard."""

    parts: tuple[str, ...]
    """Names, see `durability.parts`."""
    time: float
    """Time that the duty lasts with its repetitions [s]."""
    damage: Array
    """Miner sums over this time, without what was there before, (parts,)."""
    life: Array
    """Time until the damage is 1, from new [s], (parts,); infinite without damage. So long live
    99 % of gears and 90 % of rolling bearings."""
    passages: Array
    """Passages of each tooth over this time; 0 of bearings, (parts,)."""
    first: str
    """Part whose damage is 1 first, from what it is so far; "" without damage."""
    reliability: float
    """Share of gearboxes, of those with the damage so far, in which no part fails in this time."""
    tenth: float
    """Time in which a part fails in 10 % of them [s]."""
    remaining: RemainingLife
    """Time until the first part fails, given the damage so far."""
    equivalent: Equivalent
    """Of the tooth or bearing that fails first."""
    loads: LoadDistribution
    """Time and turns at each torque, over the whole time."""
    error: MapError
    """Of the map, measured by direct runs, by part."""
    sensitivity: list[Sensitivity]
    """Of the life of that tooth or bearing."""
    runs: int
    """Runs of the map."""
    processor: float
    """Time of processors that all took [s]."""
    remarks: tuple[str, ...]
    """What is missing or doubtful."""
    reached: Array
    """Miner sums at the start, (parts,); 0 of a new gearbox."""
    unsteady: tuple[Unsteady, ...]
    """Runs of the map whose motion does not become steady: their mean damage counts."""

    @property
    def left(self) -> Array:
        """Time until the damage is 1, from what it is at the start [s], (parts,)."""
        return left_until_one(self.life, self.reached)

    def figures(self) -> dict[str, Any]:
        """Results in SI, as JSON has them; None stands for infinite or unknown."""
        by_part = {
            part: {
                "damage": damage,
                "reached": reached,
                "left": _known(left),
                "life": _known(life),
                "passages": passages,
                "map_error": _known(mean),
                "map_error_interval": _known(bound),
            }
            for part, damage, reached, left, life, passages, mean, bound in zip(
                self.parts, self.damage.tolist(), self.reached.tolist(), self.left.tolist(),
                self.life.tolist(), self.passages.tolist(), self.error.mean.tolist(),
                self.error.bound.tolist(), strict=True,
            )
        }  # fmt: skip
        listed = ("time", "first", "reliability", "runs", "processor")
        return {
            **{name: getattr(self, name) for name in listed},
            "tenth": _known(self.tenth),
            "parts": by_part,
            "remaining": {name: _known(v) for name, v in self.remaining._asdict().items()},
            "equivalent": {
                name: v if isinstance(v, str) else _known(v)
                for name, v in self.equivalent._asdict().items()
            },
            "loads": {name: v.tolist() for name, v in self.loads._asdict().items()},
            "excerpts": {"number": self.error.excerpts, "seconds": _known(self.error.seconds)},
            "sensitivity": {each.change: _known(each.life) for each in self.sensitivity},
            "sensitivity_interval": {each.change: each.interval for each in self.sensitivity},
            "unsteady": [each._asdict() for each in self.unsteady],
            "remarks": list(self.remarks),
        }

    def __repr__(self) -> str:
        """One line."""
        return brief(self, f"{self.time:g} s", f"first: {self.first or 'none'}")


def _known(value: float) -> float | None:
    return value if math.isfinite(value) else None
