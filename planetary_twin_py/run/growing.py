"""Present severities of the faults of a run, and their growth on a grid of simulated time.

Growth is computed at multiples of `PERIOD`, from the passages of the tooth since the last of them,
at the mean mesh force of the operating point. So it does not depend on the windows of the run.
"""

from __future__ import annotations

from collections.abc import Mapping

from ..model.clock import TICKS
from ..model.growth_laws import archard_depth, paris_depth, table_severity
from ..model.layout import Layout
from ..scene import OperatingPoint, Scene
from ..scene.faults import Crack, Fault
from ..scene.growth import Archard, Paris, Table

PERIOD = TICKS // 100
"""Time between two instants at which faults grow, 10 ms [ticks of the clock]."""


class Growing:
    """Severities of a run.

    Args:
        layout: of the scene at the start of the run.
    """

    def __init__(self, layout: Layout) -> None:
        scene = layout.scene
        self._layout = layout
        self.values = scene.severities
        """Present severities by dotted name."""
        self._growing = {
            f"faults.{n}.{fault.severities[0]}": fault
            for n, fault in enumerate(scene.faults)
            if fault.growing is not None
        }
        self.next = PERIOD
        """Instant at which faults grow next [ticks]."""
        self._cycles = 0.0  # mesh cycles of the train at the last one

    @property
    def grows(self) -> bool:
        """Whether a fault grows."""
        return bool(self._growing)

    def set(self, values: Mapping[str, float]) -> None:
        """Set severities, from which faults go on growing."""
        self.values = {**self.values, **values}

    def grow(self, cycles: float, point: OperatingPoint) -> bool:
        """Grow at the instant `next`, and move it on.

        Args:
            cycles: mesh cycles of the train since the start.
            point: operating point.

        Returns:
            Whether a severity has changed.
        """
        time, passed = self.next / TICKS, abs(cycles - self._cycles)
        self.next, self._cycles = self.next + PERIOD, cycles
        before = self.values
        self.values = before | {
            name: self._grown(name, fault, time, passed, abs(cycles), point)
            for name, fault in self._growing.items()
        }
        return self.values != before

    def _grown(
        self, name: str, fault: Fault, time: float, passed: float, since_start: float,
        point: OperatingPoint,
    ) -> float:  # fmt: skip
        growth, now = fault.growing, self.values[name]
        each = _passages_per_cycle(self._layout.scene, fault)
        if isinstance(growth, Table):
            return table_severity(growth, time if growth.time else each * since_start)
        assert isinstance(growth, Paris | Archard)
        load, count = 1.0, growth.acceleration * each * passed
        if growth.force is not None:
            load = abs(self._layout.mesh_force(point.input_torque)) / growth.force
        if isinstance(growth, Paris):
            return paris_depth(growth, now, count, load)
        return archard_depth(growth, now, count, load)


def _passages_per_cycle(scene: Scene, fault: Fault) -> float:
    """Passages of a tooth through meshes with the fault, per mesh cycle."""
    gear = getattr(fault, "gear", "sun")
    of_planet = 2 if isinstance(fault, Crack) else 1  # a crack opens in both meshes
    meshes = of_planet if gear == "planet" else scene.gearset.planets
    return meshes / float(scene.gearset.tooth_numbers._asdict()[gear])
