"""Energy ledger of a run, and the efficiency of a run or a window."""

from __future__ import annotations

import math
from dataclasses import dataclass

from ..model.layout import LOAD_MACHINE, MOTOR, SECOND_MOTOR

ROUNDING = 1e-9  # of the stored energy: work below it is due to rounding


@dataclass(frozen=True)
class Energy:
    """Energy ledger of a run [J]: input = output + stored + lost - stiffness_work - weight +
    residual."""

    machines: tuple[float, ...]
    """Work on the train by motor, load, and second motor of a differential [J], (machines,)."""
    kinetic: float
    """Increase of the kinetic energy [J]."""
    elastic: float
    """Increase of the elastic energy of meshes, couplings, bearings and tooth pairs before they
    slide, and of the potential energy of the weight [J]."""
    friction: float
    """Dissipated by tooth friction [J]."""
    damping: float
    """Dissipated by the damping of meshes and couplings [J]."""
    bearing: float
    """Dissipated by bearings, seals and grease [J]."""
    churning: float
    """Dissipated by oil churning [J]."""
    stiffness_work: float
    """Work due to the change of stiffness: of the meshes with the tooth pairs in contact, and of
    pairs that do not slide yet with their load [J]."""
    stored: float
    """Kinetic and elastic energy at the end [J]."""
    weight: float = 0.0
    """Work of the weight on displaced axes as they are turned with the carrier [J]."""
    both_ways: float = 0.0
    """Work that machines have both put in and taken out, as their power changed direction [J]."""

    @property
    def input(self) -> float:
        """Work of the motors [J]."""
        return self.machines[MOTOR] + sum(self.machines[SECOND_MOTOR:])

    @property
    def output(self) -> float:
        """Work done on the load [J]."""
        return -self.machines[LOAD_MACHINE]

    @property
    def driving_work(self) -> float:
        """Work that machines have put in while they drove [J]."""
        return sum(max(work, 0.0) for work in self.machines) + self.both_ways

    @property
    def put_in(self) -> float:
        """Deprecated name of `driving_work` [J]."""
        return self.driving_work

    @property
    def driven(self) -> bool:
        """Whether work passes through the train, unlike at standstill.

        What is only stored, as where a set-point at rest winds up a shaft, does not pass.
        """
        return _passes(self.driving_work, self.gained, self.stored)

    @property
    def gained(self) -> float:
        """Increase of the kinetic and elastic energy [J]."""
        return self.kinetic + self.elastic

    @property
    def residual(self) -> float:
        """Residual of the balance, an error of the integration [J]."""
        lost = self.loss + self.damping - self.stiffness_work - self.weight
        return self.input - self.output - self.kinetic - self.elastic - lost

    @property
    def loss(self) -> float:
        """Dissipated by tooth friction, bearings, seals and churning [J]."""
        return self.friction + self.bearing + self.churning


def efficiency(loss: float, driving: float, gained: float, stored: float) -> float:
    """1 - loss/driving; NaN if no work passes through the train, as at standstill.

    Args:
        loss: dissipated by tooth friction, bearings, seals and churning [J].
        driving: work of machines while they drove [J]: a machine drives in a window, or in a span
            of at most 10 ms of a run with commands, if it puts work in over this time.
        gained: increase of the kinetic and elastic energy [J].
        stored: kinetic and elastic energy at the end [J].
    """
    return 1.0 - loss / driving if _passes(driving, gained, stored) else math.nan


def _passes(driving: float, gained: float, stored: float) -> bool:
    """Whether work passes through the train, more than what is stored and than rounding."""
    return driving - max(gained, 0.0) > ROUNDING * stored
