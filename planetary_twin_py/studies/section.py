"""Poincare section: a running train looked at each time the sun has turned by one tooth.

The section is a place, not a clock: it asks nothing of the drive's speed being steady, and motion
that repeats with the meshing is one point of it.
"""

from __future__ import annotations

import math
from fractions import Fraction

import numpy as np

from ..dynamics.bodies import body_names, mesh_names
from ..dynamics.observe import DTE
from ..integrators.interpolant import Samples
from ..run import start
from ..scene import Scene

GUARD = 0.05  # mesh cycles before the section to which the mean speed leads; the sun swings less
SHORT = 0.98  # of what is left then, by the speed there: a section behind cannot be reached
EXACT = 1e-6  # mesh cycles before it that count as there
MISSED = 1e-4  # mesh cycles beyond it that do not


class Section:
    """A run of `scene`, held at one speed after the other, that shows its meshes at one phase.

    The mesh phase is that of the sun against the carrier: at 0 a tooth pair of the first mesh
    stands at the pitch point.

    Raises:
        ValueError: the scene has no vibrations, or it or the tolerance cannot be.
    """

    def __init__(self, scene: Scene, tolerance: float, phase: float = 0.0) -> None:
        if scene.dynamics != "torsional":
            raise ValueError(
                f"dynamics = {scene.dynamics!r}: must be torsional, without it nothing vibrates"
            )
        self._scene, self._point, self._tolerance = scene, scene.operating_point, tolerance
        self._run = start(scene, tolerance)
        names, self._meshes = body_names(scene), mesh_names(scene).place
        # Sun and carrier: where they are among the bodies, and what they turn per turn of a motor.
        self._places = names.place[[names.names.index("sun"), names.names.index("carrier")]]
        self._ratio = self._run.train.ratio[self._places]
        self._teeth, self._phase = scene.gearset.teeth.sun, phase
        self._pace()
        self._time = Fraction(0)

    @property
    def time(self) -> float:
        """Simulated time [s]."""
        return float(self._time)

    def hold(self, speed: float, duration: float) -> None:
        """Change the set-point of the first motor to `speed` [rad/s] and run on [s]."""
        self._point = self._scene.replace(
            **{**self._point.model_dump(), "input_speed": speed}
        ).operating_point
        self._pace()
        self._run.change(self._point, self._tolerance, self._time)
        self._go(duration)

    def dte(self) -> np.ndarray:
        """DTE at the next passage of the section [m], shape (meshes,).

        Raises:
            ArithmeticError: the sun swings by so much of a tooth that the passage is missed.
        """
        samples = self._run.sample(self._time)
        cycle, rate = self._passed(samples)
        passage = math.floor(cycle + GUARD) + 1.0
        while (left := passage - cycle) > EXACT:
            far = left > 2.0 * GUARD
            samples = self._go((left - GUARD) / self._frequency if far else SHORT * left / rate)
            cycle, rate = self._passed(samples)
        if left < -MISSED:
            raise ArithmeticError(
                f"t = {self.time:.6g} s: the sun swings past the mesh phase that is looked at"
            )
        return np.array(samples.mesh[0, DTE, self._meshes])

    def _pace(self) -> None:
        """Rate at which teeth pass a mesh at the speed that is set [Hz], and which way is ahead."""
        speeds = np.array([self._point.input_speed, self._point.second_input_speed])
        sun, carrier = self._ratio @ speeds[: self._ratio.shape[1]]
        rate = self._teeth * (sun - carrier) / (2.0 * math.pi)
        self._frequency, self._ahead = float(abs(rate)), math.copysign(1.0, rate)

    def _passed(self, samples: Samples) -> tuple[float, float]:
        """Mesh cycles passed since phase 0, and their rate [Hz], both positive ahead."""
        turned = self._ratio @ samples.turns[0] + self._of(samples.angle) / (2.0 * math.pi)
        cycles, rate = (
            self._ahead * self._teeth * (sun - carrier)
            for sun, carrier in (turned, self._of(samples.speed) / (2.0 * math.pi))
        )
        return float(cycles - self._ahead * self._phase), float(rate)

    def _of(self, bodies: np.ndarray) -> np.ndarray:
        """Sun and carrier of samples (1, bodies); a held member stands at zero."""
        return np.append(bodies[0], 0.0)[self._places]

    def _go(self, duration: float) -> Samples:
        self._time += Fraction(duration)
        return self._run.sample(self._time)
