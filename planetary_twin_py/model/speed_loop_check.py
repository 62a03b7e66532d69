"""Refuses operating points at which the speed loop of the drive is not stable."""

from __future__ import annotations

import math

import numpy as np

from .._core import AXES
from ..scene import OperatingPoint, SceneError
from .gearbox import Gearbox
from .speed_loop import LEAST_MARGIN, LinearTrain, holds_a_speed, rounded_down

FIELD = "drive.speed_control.bandwidth"
FREQUENCIES_KEPT = 64


class SpeedLoopCheck:
    """Refuses operating points at which the speed loop is unstable or has too little margin.

    Args:
        gearbox: of the scene of the drive.
    """

    def __init__(self, gearbox: Gearbox) -> None:
        scene, train = gearbox.scene, gearbox.held.train
        self._cycles, self._chosen = train.cycle.per_turn.copy(), gearbox.bandwidth
        self._is_default = scene.drive.speed_control.bandwidth is None
        self._linear = LinearTrain(gearbox, train)
        # A brake is never refused.
        self._checks = holds_a_speed(scene) and "brake" not in scene.drive.ports
        self._stable: set[float] = set()  # recent mesh frequencies [Hz] that are stable

    def check(self, point: OperatingPoint) -> None:
        """Check an operating point; mesh damping may depend on its speeds.

        Raises:
            SceneError: the loop is not stable at sqrt(2) times its bandwidth.
        """
        if not self._checks:
            return
        speeds = np.zeros(AXES)
        speeds[:] = point.input_speed, point.second_input_speed
        frequency = abs(float(self._cycles @ speeds)) / (2.0 * math.pi)
        if frequency not in self._stable:
            self._check_at(frequency)
            if len(self._stable) >= FREQUENCIES_KEPT:
                self._stable.clear()
            self._stable.add(frequency)

    def _check_at(self, mesh_frequency: float) -> None:
        loop, chosen = self._linear.loop(mesh_frequency), self._chosen
        unstable = [b for b in (chosen, LEAST_MARGIN * chosen) if not loop.is_stable(b)]
        if not unstable:
            return
        limit = loop.limit(unstable[0])
        growing = max(loop.eigenvalues(unstable[0]), key=lambda value: value.real)
        name = f"{chosen:g} Hz, the default" if self._is_default else f"{chosen:g} Hz"
        highest = limit / LEAST_MARGIN
        allowed = f"must be at most {rounded_down(highest):g} Hz: " if highest else ""
        above = f"above {limit:.3g} Hz" if highest else "at any bandwidth"
        default = "" if self._is_default or not highest else "leave it out for the default, or "
        raise SceneError(
            f"{FIELD} = {name}: {allowed}the speed loop is unstable {above}, where motors and load "
            f"oscillate on their couplings at {abs(growing.imag) / (2.0 * math.pi):.3g} Hz; "
            f"{default}give the drive stiffer couplings or more damping"
        )
