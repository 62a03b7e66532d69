"""Poincare section: samples of a running train each time the sun has turned by one tooth.

The section is defined by angle, not by time, so that it does not require a constant speed. A motion
with the period of the mesh cycle is one point of the section.
"""

from __future__ import annotations

import math
from fractions import Fraction

import numpy as np

from .._core import DTE
from ..run.counters import Course, course_so_far
from ..run.samples import Samples
from ..run.start import start
from ..scene import Scene

GUARD = 0.05  # mesh cycles before the section at which the approach by the mean speed ends
SHORT = 0.98  # fraction of the remaining distance per step, to avoid overshooting the section
EXACT = 1e-6  # mesh cycles before the section that count as reached
MISSED = 1e-4  # mesh cycles beyond the section that count as missed


class Section:
    """A run at a sequence of speeds, sampled at one phase of the mesh cycle.

    The mesh phase is that of the sun relative to the carrier: at 0 a tooth pair of the first mesh
    is at the pitch point.

    Args:
        scene: the gearbox.
        tolerance: relative local error tolerance of the integrator.
        phase: phase of the section, in [0, 1).

    Raises:
        ValueError: the scene is quasi-static, or an argument is out of range.
    """

    def __init__(self, scene: Scene, tolerance: float, phase: float = 0.0) -> None:
        if scene.dynamics != "torsional":
            raise ValueError(f"dynamics = {scene.dynamics!r}: must be torsional for vibration")
        self._scene, self._point, self._tolerance = scene, scene.operating_point, tolerance
        self._run = start(scene, tolerance)
        names = self._run.gearbox.body_names
        self._meshes = self._run.gearbox.mesh_names.place
        # Sun and carrier: their indices among the bodies, and their turns per turn of each motor.
        self._places = names.place[[names.names.index("sun"), names.names.index("carrier")]]
        self._ratio = self._run.train.ratio[self._places]
        self._teeth, self._phase = scene.gearset.teeth.sun, phase
        self._set_mesh_frequency()
        self._time = Fraction(0)

    @property
    def time(self) -> float:
        """Simulated time [s]."""
        return float(self._time)

    @property
    def course(self) -> Course:
        """Counters of the run from its start."""
        return course_so_far(self._run.control, unsettled=0.0)

    def hold(self, speed: float, duration: float) -> None:
        """Set the speed of the first motor to `speed` [rad/s] and simulate `duration` [s]."""
        self._point = self._scene.replace(
            **{**self._point.model_dump(), "input_speed": speed}
        ).operating_point
        self._set_mesh_frequency()
        self._run.change(self._point, self._tolerance, self._time)
        self._advance(duration)

    def dte(self) -> np.ndarray:
        """DTE at the next passage of the section [m], shape (meshes,).

        Raises:
            ArithmeticError: the sun oscillates so strongly that the passage is missed.
        """
        samples = self._run.sample(self._time)
        cycle, rate = self._mesh_cycles(samples)
        passage = math.floor(cycle + GUARD) + 1.0
        while (remaining := passage - cycle) > EXACT:
            distant = remaining > 2.0 * GUARD
            duration = (
                (remaining - GUARD) / self._frequency if distant else SHORT * remaining / rate
            )
            samples = self._advance(duration)
            cycle, rate = self._mesh_cycles(samples)
        if remaining < -MISSED:
            raise ArithmeticError(
                f"t = {self.time:.6g} s: the sun oscillates across the sampled mesh phase"
            )
        return np.array(samples.mesh[0, DTE, self._meshes])

    def _set_mesh_frequency(self) -> None:
        """Set the mesh frequency [Hz] at the speed set-point, and its sign."""
        speeds = np.array([self._point.input_speed, self._point.second_input_speed])
        sun, carrier = self._ratio @ speeds[: self._ratio.shape[1]]
        rate = self._teeth * (sun - carrier) / (2.0 * math.pi)
        self._frequency, self._direction = float(abs(rate)), math.copysign(1.0, rate)

    def _mesh_cycles(self, samples: Samples) -> tuple[float, float]:
        """Mesh cycles since phase 0, and their rate [Hz], positive in the direction of running."""
        turned = self._ratio @ samples.turns[0] + self._sun_and_carrier(samples.angle) / (
            2.0 * math.pi
        )
        cycles, rate = (
            self._direction * self._teeth * (sun - carrier)
            for sun, carrier in (turned, self._sun_and_carrier(samples.speed) / (2.0 * math.pi))
        )
        return float(cycles - self._direction * self._phase), float(rate)

    def _sun_and_carrier(self, bodies: np.ndarray) -> np.ndarray:
        """Sun and carrier of samples (1, bodies); 0 for a held member."""
        return np.append(bodies[0], 0.0)[self._places]

    def _advance(self, duration: float) -> Samples:
        self._time += Fraction(duration)
        return self._run.sample(self._time)
