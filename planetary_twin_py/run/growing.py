"""Present severities of the faults of a run, and their growth on a grid of simulated time.

Growth is computed at multiples of `PERIOD`: from the passages of the tooth since the last of them
or, where a law follows the load, from its largest load in each passage that has ended. It is that
of samples at `LOAD_RATE`. So it does not depend on the windows of the run.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from ..model.clock import TICKS
from ..model.gearbox import Gearbox
from ..model.growth_laws import archard_depth, paris_depth, table_severity
from ..model.pair_loads import train_with
from ..model.passages import Passages
from ..scene import Scene
from ..scene.faults import Crack, Fault, Wear
from ..scene.growth import Archard, LawGrowth, Paris, Table

PERIOD = TICKS // 100
"""Time between two instants at which faults grow, 10 ms [ticks of the clock]."""
LOAD_RATE = 50_000
"""Rate of the samples from which loads of faulty teeth follow [Hz]."""


class Growing:
    """Severities of a run.

    Args:
        gearbox: of the scene at the start of the run.
    """

    def __init__(self, gearbox: Gearbox) -> None:
        scene = gearbox.scene
        self._gearbox = gearbox
        self.values = scene.severities
        """Present severities by dotted name."""
        self._growing = {
            f"faults.{n}.{fault.severities[0]}": fault
            for n, fault in enumerate(scene.faults)
            if fault.growing is not None
        }
        self._passages = {
            name: Passages(gearbox, fault)
            for name, fault in self._growing.items()
            if isinstance(fault, Crack | Wear)
            and isinstance(fault.growing, LawGrowth)
            and fault.growing.force is not None
        }
        self._train = train_with(gearbox, self.values) if self._passages else None
        self.next = PERIOD
        """Instant at which faults grow next [ticks]."""
        self._cycles = 0.0  # mesh cycles of the train at the last one

    @property
    def grows(self) -> bool:
        """Whether a fault grows."""
        return bool(self._growing)

    @property
    def follows_load(self) -> bool:
        """Whether a fault grows by the load of its tooth."""
        return bool(self._passages)

    def set(self, values: Mapping[str, float]) -> None:
        """Set severities, from which faults go on growing."""
        self._put({**self.values, **values})

    def _put(self, values: Mapping[str, float]) -> None:
        self.values = dict(values)
        if self._passages:
            self._train = train_with(self._gearbox, self.values)

    def begin(self, ticks: int, cycles: float) -> None:
        """Begin within a run.

        Args:
            ticks: last instant at which faults grew [ticks].
            cycles: mesh cycles of the train there.
        """
        self.next, self._cycles = ticks + PERIOD, cycles

    def feed(self, angle: Mapping[str, np.ndarray], force: np.ndarray) -> None:
        """Continue with samples, if a fault grows by the load of its tooth.

        Args:
            angle: angles of the members [rad] (n,), see `Passages.feed`.
            force: of all meshes [N], (n, meshes).
        """
        if self._train is not None and len(force):
            for passages in self._passages.values():
                passages.feed(angle, force, self._train)

    def grow(self, cycles: float) -> bool:
        """Grow at the instant `next`, and move it on.

        Args:
            cycles: mesh cycles of the train since the start.

        Returns:
            Whether a severity has changed.
        """
        time, passed = self.next / TICKS, abs(cycles - self._cycles)
        self.next, self._cycles = self.next + PERIOD, cycles
        grown = self.values | {
            name: self._grown(name, fault, time, passed, abs(cycles))
            for name, fault in self._growing.items()
        }
        changed = grown != self.values
        if changed:
            self._put(grown)
        return changed

    def _grown(
        self, name: str, fault: Fault, time: float, passed: float, since_start: float
    ) -> float:
        growth, now = fault.growing, self.values[name]
        each = _passages_per_cycle(self._gearbox.scene, fault)
        if isinstance(growth, Table):
            return table_severity(growth, time if growth.time else each * since_start)
        assert isinstance(growth, Paris | Archard)
        passages = self._passages.get(name)
        if passages is None:
            return _deepened(growth, now, growth.acceleration * each * passed, 1.0)
        assert growth.force is not None
        for load in passages.ended():
            now = _deepened(growth, now, growth.acceleration * passages.weight, load / growth.force)
        return now


def _deepened(growth: Paris | Archard, depth: float, passages: float, load: float) -> float:
    if isinstance(growth, Paris):
        return paris_depth(growth, depth, passages, load)
    return archard_depth(growth, depth, passages, load)


def _passages_per_cycle(scene: Scene, fault: Fault) -> float:
    """Passages of a tooth through meshes with the fault, per mesh cycle."""
    gear = getattr(fault, "gear", "sun")
    of_planet = 2 if isinstance(fault, Crack) else 1  # a crack opens in both meshes
    meshes = of_planet if gear == "planet" else scene.gearset.planets
    return meshes / float(scene.gearset.tooth_numbers._asdict()[gear])
