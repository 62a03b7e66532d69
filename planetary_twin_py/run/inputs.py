"""Operating point, oil and ports of a run, as the core reads them."""

from __future__ import annotations

from .. import _core
from .._core import Integrator, Model, keep_given, prescribe
from ..model.cycle import common_cycles, turns_per_cycle
from ..model.error_scale import POINTS, StepScale
from ..model.gearbox import Gearbox
from ..model.library import record_in
from ..model.oil import build_oil
from ..scene import OperatingPoint

SETTLING = 1.0  # periods of the speed loop until steady running may be recognised


class Inputs:
    """Puts operating points into the model of a run, and scales its tolerances to them.

    Args:
        gearbox: of the scene at the start.
        model: receives oil and loads.
        integrator: receives tolerances, and after how many mesh cycles everything repeats.
        may_repeat: whether periodic motion may be repeated without computing it.
    """

    def __init__(
        self, gearbox: Gearbox, model: Model, integrator: Integrator, may_repeat: bool
    ) -> None:
        scene = gearbox.scene
        self._gearbox, self._train, self._core = gearbox, gearbox.train, gearbox.core
        self._model, self._integrator, self._may_repeat = model, integrator, may_repeat
        self._scale = StepScale(gearbox)
        self._given = False
        self.oil = build_oil(scene, scene.operating_point)
        """At the operating point."""
        self._oil_temperature = scene.operating_point.oil_temperature
        self._cycles: dict[bool, int] = {}  # by whether the torque ripples
        self._pause = SETTLING / gearbox.bandwidth

    def set_ports(self, gearbox: Gearbox) -> None:
        """Take the ports of another scene from the next operating point on."""
        self._gearbox, self._given = gearbox, False
        self._cycles.clear()

    def put(self, point: OperatingPoint, tolerance: float) -> None:
        """Put an operating point into the model, and scale the tolerances to its deflections.

        Args:
            point: the operating point.
            tolerance: local error of a step, relative to the static deflection of the meshes.
        """
        self._put_oil(point)
        operation = self._gearbox.operation(point)
        if self._given:  # values given at ports do not depend on the operating point
            keep_given(record_in(_core, self._model.operation), operation)
        self._model.operation = record_in(self._core, operation)
        self._given = self._gearbox.scene.drive.ports.given
        control, scale = self._integrator.control, self._scale
        control.tolerance = tolerance
        control.deflection = scale.deflection(point)
        control.elastic_deflection = scale.elastic_deflection(point)
        control.acceleration_deflection = scale.acceleration_deflection(self._model.operation)
        control.speed_per_deflection = scale.speed_per_deflection
        points = next(n for least, n in POINTS if tolerance > least)
        if self._integrator.run.nodes.count != points:
            self._integrator.run.nodes = self._core.radau(points)
        control.changed = True
        self._allow_periodic()

    def _put_oil(self, point: OperatingPoint) -> None:
        if point.oil_temperature != self._oil_temperature:
            self.oil = build_oil(self._gearbox.scene, point)
            self._oil_temperature = point.oil_temperature
        prescribe(self.oil, point.lambda_ratio)
        self._model.oil = record_in(self._core, self.oil)

    def _allow_periodic(self) -> None:
        """Set the number of mesh cycles after which everything repeats."""
        periodic, operation = self._integrator.periodic, self._model.operation
        rippled = operation.ripple != 0.0
        if rippled not in self._cycles:
            may_repeat = self._may_repeat and not self._gearbox.scene.drive.ports.given
            self._cycles[rippled] = common_cycles(self._train, operation) if may_repeat else 0
        cycles = self._cycles[rippled]
        if cycles > 0:
            turns = abs(cycles * turns_per_cycle(self._train))
            periodic.numerator, periodic.denominator = turns.numerator, turns.denominator
        periodic.cycles = cycles
        periodic.pause = self._pause
