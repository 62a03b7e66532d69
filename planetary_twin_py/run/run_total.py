"""What consecutive windows of a run add up to."""

from __future__ import annotations

import math

import numpy as np

from .._core import (
    BEARING,
    CHURNING,
    DAMPING,
    FRICTION,
    MESH_POWER,
    POWER_LOSS,
    STIFFNESS_WORK,
    WEIGHT,
    WORK,
    WindowEnd,
)
from ..durability.account import Account
from ..durability.damage import Damage, DamageTotal
from .energy import Energy
from .warming import mean_heat
from .window import by_name
from .windows import Windows

ROUNDING = 8.0 * np.finfo(float).eps  # of an angle, relative


class RunTotal:
    """Energy ledger and sums of the meshes from the present time on.

    Windows end within steps, in which they take powers as constant. Here, the first and the last
    one are those of steps that end exactly there.
    """

    def __init__(self, windows: Windows) -> None:
        core = windows.run.gearbox.core
        self._core, self._windows, self._train = core, windows, windows.run.train
        self._begin, self._total, self._last = (core.WindowEnd() for _ in range(3))
        windows.run.exact_end(windows.ticks, self._begin)
        self._total.ledger = -self._begin.ledger  # what was before the start
        self._machines = int(self._train.machines)
        self._counted = np.zeros(self._machines)  # work of complete spans
        self._work = np.zeros((2, self._machines))  # that they have put in, and taken out [J]
        self._figures = core.Figures()
        scene, places = windows.run.gearbox.scene, windows.run.gearbox.mesh_names.place
        self._account = None if scene.durability is None else Account(scene, places)
        self._damage = DamageTotal()
        self._duration = math.nan

    def add(self, end: WindowEnd, new_span: bool) -> None:
        """Add a window.

        Args:
            end: its end.
            new_span: whether a machine may drive in this window that is driven in the one before.
        """
        if new_span and self._total.sums.time > 0.0:
            self._end_span()
        self._core.extend(self._train, end, self._total)
        if self._account is not None:
            self._damage.add(self._account.damage(end.sums, float(end.sums.time)))

    def close(self, duration: float) -> None:
        """End the last window exactly at the present time.

        Args:
            duration: time of all windows [s].
        """
        last, total, self._duration = self._last, self._total, duration
        self._windows.run.exact_end(self._windows.ticks, last)
        total.ledger = total.ledger + last.ledger
        total.kinetic, total.elastic = last.kinetic, last.elastic
        self._end_span()
        self._core.window_figures(
            self._train, self._windows.report, self._begin, total, duration, self._figures
        )

    def _end_span(self) -> None:
        work = self._total.ledger[WORK : WORK + self._machines]
        gained = work - self._counted
        self._work += np.maximum([gained, -gained], 0.0)
        self._counted = work.copy()

    @property
    def energy(self) -> Energy:
        """Energy ledger."""
        begin, total, ledger = self._begin, self._total, self._total.ledger
        return Energy(
            machines=tuple(ledger[WORK : WORK + self._machines].tolist()),
            kinetic=total.kinetic - begin.kinetic,
            elastic=total.elastic - begin.elastic,
            friction=float(ledger[FRICTION]),
            damping=float(ledger[DAMPING]),
            bearing=float(ledger[BEARING]),
            churning=float(ledger[CHURNING]),
            stiffness_work=float(ledger[STIFFNESS_WORK]),
            weight=float(ledger[WEIGHT]),
            stored=total.kinetic + total.elastic,
            both_ways=float(self._work.min(axis=0).sum()),
        )

    @property
    def heat(self) -> dict[str, float]:
        """Mean heat by source over the time of the windows [W]."""
        return mean_heat(self._begin, self._last, self._duration)

    @property
    def mean_speed(self) -> np.ndarray:
        """Mean speeds of the reported bodies [rad/s], (bodies,); 0 if only rounding moves one."""
        begin, total, report = self._begin, self._total, self._windows.report
        place = report.body[: report.bodies]
        stands = np.isclose(begin.angle[place], total.angle[place], rtol=ROUNDING, atol=0.0)
        stands &= np.array_equal(begin.turns, total.turns)
        return np.where(stands, 0.0, self._figures.mean_speed[: report.bodies])

    @property
    def mesh(self) -> dict[str, np.ndarray]:
        """Statistics of the reported meshes, see `window.by_name`."""
        return by_name(self._figures.statistics[:, : self._windows.report.meshes].copy())

    @property
    def damage(self) -> Damage | None:
        """Damage of the parts over all windows; None if the scene has no section for it."""
        return self._damage.total

    @property
    def mesh_efficiency(self) -> tuple[float, float]:
        """Efficiency of the sun meshes and of the ring meshes."""
        place = self._windows.report.mesh[: self._windows.report.meshes]
        lost, rolled = (
            self._total.sums.integral[row][place].reshape(2, -1).sum(axis=1)
            for row in (POWER_LOSS, MESH_POWER)
        )
        with np.errstate(invalid="ignore"):
            sun, ring = 1.0 - lost / rolled
        return float(sun), float(ring)
