"""Samples of the loads of faulty teeth, by which their faults grow."""

from __future__ import annotations

import math
from collections.abc import Iterable
from fractions import Fraction

from ..model.gearbox import Gearbox
from .growing import LOAD_RATE, Growing
from .samples import Asked, WaveRoom
from .window_jobs import Grid, grid

ASKED = Asked(frozenset({"mesh_force"}), bodies=True)


class GrowthLoads:
    """Asks for samples beside those of a window, and feeds them to the faults.

    Args:
        gearbox: of the scene at the start of the run.
        growing: faults of the run.
    """

    def __init__(self, gearbox: Gearbox, growing: Growing) -> None:
        self._gearbox, self._growing = gearbox, growing
        self._room: WaveRoom | None = None
        self._first = 1  # number of the next sample

    def until(self, time: Fraction) -> tuple[Grid, ...]:
        """Samples up to `time` [s]; none unless faults grow by the load of their teeth."""
        if not self._growing.follows_load:
            return ()
        if self._room is None:
            self._room = WaveRoom(self._gearbox.train, self._gearbox.report, ASKED)
        rows = math.floor(time * LOAD_RATE) + 1 - self._first
        return (grid(self._first, float(LOAD_RATE), self._room.new(max(rows, 0))),)

    def feed(self, loads: Iterable[Grid]) -> None:
        """Continue with the samples of `until`, which the core has filled."""
        for each in loads:
            bodies, (force,) = each.out.bodies, each.out.asked_of_meshes
            assert bodies is not None
            names = self._gearbox.body_names.names
            self._growing.feed(dict(zip(names, bodies.angle.T, strict=True)), force)
            self._first += len(force)
