"""Largest loads of a faulty tooth in its passages through the meshes, from samples of a run."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import numpy as np

from .._core import Train
from ..scene.faults import Crack, Wear
from .fault_places import faulty_pairs, kinds_of
from .gearbox import Gearbox
from .pair_loads import Array, cycles_of, pair_loads


class Passages:
    """Passages of the faulty tooth of a fault; of a fault of all teeth, those of every tooth."""

    def __init__(self, gearbox: Gearbox, fault: Crack | Wear) -> None:
        self._gearbox, self._fault = gearbox, fault
        held = gearbox.held
        teeth, planets = held.scene.gearset.tooth_numbers, held.scene.gearset.planets
        self._every = getattr(fault, "tooth", 0) == "all"
        self._teeth: int = teeth._asdict()[fault.gear]
        phases = np.array([float(phase) for kind in held.phases for phase in kind])
        pairs = faulty_pairs(fault, teeth, range(planets), phases)
        self._meshes = [
            (mesh, float(phases[mesh]), pairs[mesh])
            for mesh in range(2 * planets)
            if (pairs[mesh] >= 0).any()
        ]
        self._reach = max(_reach(held.train, kind) for kind in kinds_of(fault))
        self._open: dict[tuple[int, float, int], float] = {}
        self._ended: list[float] = []

    @property
    def weight(self) -> float:
        """Share of a tooth in a passage: 1, or one of all teeth."""
        if not self._every:
            return 1.0
        every = getattr(self._fault, "planet", 1) == "all"
        shared = self._gearbox.scene.gearset.planets if every else 1
        return 1.0 / (self._teeth * (shared if self._fault.gear == "planet" else 1))

    def feed(self, angle: Mapping[str, Array], force: Array, train: Train) -> None:
        """Continue with samples.

        Args:
            angle: angles of the members [rad] (n,), not modulo a turn, see `pair_loads`.
            force: forces of all meshes [N] (n, meshes), negative on the coast flanks.
            train: with the present severities, see `train_with`.
        """
        for mesh, phase, pairs in self._meshes:
            for side, first in ((1.0, pairs[0]), (-1.0, pairs[1])):
                if first >= 0:
                    own = side * force[:, mesh] > 0.0
                    self._pass(mesh, phase, side, int(first), angle, force[:, mesh] * own, train)

    def _pass(
        self, mesh: int, phase: float, side: float, first: int, angle: Mapping[str, Array],
        force: Array, train: Train,
    ) -> None:  # fmt: skip
        held, kind = self._gearbox.held, mesh // self._gearbox.scene.gearset.planets
        gear = self._fault.gear
        member = f"planet_{mesh % held.scene.gearset.planets + 1}" if gear == "planet" else gear
        cycle = side * (cycles_of(held, member, angle) - phase)
        if side < 0.0:
            cycle += train.geometry.coast_lead[kind]
        found = pair_loads(self._gearbox, mesh, angle, force, train)
        number = np.rint(cycle[:, None] - (found.position - found.ahead)).astype(np.int64)
        own = found.load > 0.0
        if not self._every:
            own &= (number - first) % self._teeth == 0
        for pair in np.unique(number[own]):
            peak = float(np.where(own & (number == pair), found.load, 0.0).sum(axis=1).max())
            place = mesh, side, int(pair)
            self._open[place] = max(self._open.get(place, 0.0), peak)
        for place in [*self._open]:
            if place[:2] == (mesh, side) and abs(cycle[-1] - place[2]) > self._reach:
                self._ended.append(self._open.pop(place))

    def ended(self) -> Iterator[float]:
        """Largest loads [N] in the passages that have ended since the last call."""
        found, self._ended = self._ended, []
        yield from found


def _reach(train: Train, kind: int) -> float:
    """Mesh cycles from the pitch point within which a pair may be in contact."""
    segments, slots = int(train.teeth.segments[kind]), int(train.teeth.slots)
    edges = np.abs(train.teeth.edge[kind, : segments + 1]).max()
    return float(edges + np.abs(train.teeth.shift[kind, :segments, :slots]).max())
