"""Scales and initial values of the step control."""

from __future__ import annotations

import math
from types import ModuleType

import numpy as np

from .._core import METHODS, Integrator, Operation, deflection_at, elastic_deflection
from ..scene import OperatingPoint
from .gearbox import Gearbox
from .point_laws import record_of
from .train import lightest_body

# Lowest tolerance for each number of collocation points. Three points save nothing: a step costs
# nearly as much, and needs to be shorter.
POINTS = ((3e-4, 4), (0.0, 5))
LONGEST_STEP = 1e-3  # [s]
FIRST_STEP = 1e-6  # [s]


class StepScale:
    """Deflections to which the tolerance of a step is relative."""

    def __init__(self, gearbox: Gearbox) -> None:
        train, self._laws = gearbox.train, gearbox.laws
        self._per_torque = abs(gearbox.mesh_force(1.0))
        self._stiffness = float(train.teeth.stiffness.min())
        self._shares = np.abs(gearbox.machine_torques[::2])
        motors = train.coupling.ends[: 2 * len(self._shares) : 2, 0]
        self._own = train.body.mass[motors] * train.body.radius[motors] ** 2
        self.speed_per_deflection = math.sqrt(2.0 * self._stiffness / lightest_body(train))

    def deflection(self, point: OperatingPoint) -> float:
        """Deflection of the meshes under the torques of steady running, and half the backlash.

        Returns:
            The deflection [m].
        """
        return deflection_at(self._laws, record_of(point))

    def elastic_deflection(self, point: OperatingPoint) -> float:
        """Elastic part of `deflection`, without half the backlash.

        Returns:
            The deflection [m].
        """
        return elastic_deflection(self._laws, record_of(point))

    def acceleration_deflection(self, operation: Operation) -> np.ndarray:
        """Deflection of the meshes per acceleration of each input.

        The inertia of a motor itself does not load the meshes.

        Args:
            operation: gives the inertia at the motors.

        Returns:
            Deflection per acceleration [m s^2/rad], (inputs,).
        """
        inertia = operation.inertia.diagonal()[: len(self._own)]
        torque: np.ndarray = np.maximum(inertia - self._own, 0.0) / self._shares
        return self._per_torque * torque / self._stiffness


def new_integrator(core: ModuleType, method: str) -> Integrator:
    """Make the state of the integrator before its first step.

    Args:
        core: module of the compiled core that fits the scene.
        method: one of METHODS, see `Engine`.
    """
    integrator: Integrator = core.Integrator()
    control = integrator.control
    control.step = control.next_step = control.next_stiff = FIRST_STEP
    control.longest = LONGEST_STEP
    control.method = METHODS[method]
    return integrator
