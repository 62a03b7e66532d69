"""Damage of steady running at one operating point."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..model.cycle import common_cycles
from ..model.gearbox import Gearbox
from ..run.twin import Twin
from ..scene import Scene
from ..simulation.simulate import selected

Array = NDArray[np.float64]

TOLERANCE = 1e-6  # damage is a high power of the peaks
BLOCK = 10  # mesh cycles that are compared with the next ones
MOST_CYCLES = 5000  # of a block: errors and faults of all gears may meet again only after ages
AGREEING = 3  # blocks in a row with the same damage; two of a chaotic motion may agree by chance
JUDGED = 30, 60, 120, 240  # blocks after which the mean of their later half may be enough
BATCHES = 5  # of that half, whose means show what the mean is worth
PATIENT = 2400  # mesh cycles of a run by which a map is judged
ENOUGH = 5e-3  # half the interval of a mean that is
SAME = 2e-3  # relative difference of the damage of blocks up to which it is steady
NEGLIGIBLE = 1e-6  # of the largest damage: below, a part need not be steady
LONGEST = 50.0  # [s] of a window
FEW = 16  # samples of a block, which nobody reads
CONFIDENCE = 0.95


class SteadyDamage(NamedTuple):
    """Damage over the angle that the input turns."""

    per_angle: Array
    """Miner sums over angle [1/rad], (parts,)."""
    interval: Array
    """Half the 95 % interval of these means over themselves, (parts,); 0 of steady motions."""

    @property
    def doubt(self) -> float:
        """The interval of the part with the largest damage."""
        return float(self.interval[self.per_angle.argmax()])


class Unsteady(NamedTuple):
    """An operating point whose motion does not become steady, such as a chaotic one."""

    input_torque: float
    """[N m]"""
    input_speed: float
    """[rad/s]"""
    oil_temperature: float
    """[K]"""
    interval: float
    """Half the 95 % interval of the mean damage over this mean, of the most damaged part."""


def steady_scene(scene: Scene, **changes: Any) -> Scene:
    """A scene that runs steadily at its operating point, with the dynamics selected for it.

    Args:
        scene: any scene: without a start from rest, and with the oil temperature of its point.
        changes: see `Scene.replace`.
    """
    plain = scene.replace(**{"drive.speed_control.start_speed": None, "thermal": None})
    return selected(plain.replace(**changes))[0]


def steady_damage(scene: Scene) -> SteadyDamage:
    """Damage over the angle that the input turns, after transients have decayed.

    Args:
        scene: the gearbox with its operating point; its dynamics are selected and it turns.

    Returns:
        The damage; of a motion that does not become steady, the mean over its later half.

    Raises:
        ValueError: a stress is above that of the S-N curve.
        RunawayError: the run exceeds physical limits.
    """
    run = _Blocks(scene)
    found: list[Array] = []
    while True:
        found.append(run.next())
        if len(found) >= AGREEING and all(_same(each, found[-1]) for each in found[-AGREEING:-1]):
            return SteadyDamage(found[-1], np.zeros(len(found[-1])))
        if len(found) in JUDGED:
            mean = _mean_of(np.array(found[len(found) // 2 :]))
            if mean.doubt <= ENOUGH or len(found) == JUDGED[-1]:
                return mean


def long_run_damage(scene: Scene) -> Array:
    """Damage over the angle that the input turns, after many more mesh cycles.

    A motion may stay near a cycle that is not stable for a second, and steps may fall on the same
    phases of a few cycles. `steady_damage` takes this as steady, so this one judges it.

    Args:
        scene: see `steady_damage`.

    Returns:
        Miner sums over angle [1/rad], (parts,).

    Raises:
        ValueError, RunawayError: see `steady_damage`.
    """
    if scene.quasi_static:  # every mesh cycle is its own equilibrium
        return steady_damage(scene).per_angle
    run = _Blocks(scene)
    count = max(2 * AGREEING, math.ceil(PATIENT / run.cycles))
    found = [run.next() for _ in range(count)]
    return np.asarray(np.mean(found[count // 2 :], axis=0))


class _Blocks:
    """A run in blocks of mesh cycles, in which everything periodic repeats."""

    def __init__(self, scene: Scene) -> None:
        gearbox = Gearbox(scene)
        period = common_cycles(gearbox.train, gearbox.operation(scene.operating_point))
        # Pits in bearings never repeat.
        self.cycles = min(period * math.ceil(BLOCK / period), MOST_CYCLES) if period else BLOCK
        """Mesh cycles of a block."""
        self._duration = self.cycles / gearbox.mesh_frequency
        self._angle = abs(scene.operating_point.input_speed) * self._duration
        self._twin = Twin(scene, max(FEW / self._duration, 1.0), TOLERANCE)

    def next(self) -> Array:
        """Miner sums of the next block over angle [1/rad], (parts,)."""
        return damage_of(self._twin, self._duration) / self._angle


def unsteady_remark(found: Sequence[Unsteady], runs: int) -> str | None:
    """A line on the runs of a map that do not become steady; None without any.

    Args:
        found: these runs.
        runs: of the whole map.
    """
    if not found:
        return None
    worst = max(found, key=lambda each: each.interval)
    return (
        f"{len(found)} of {runs} runs of the map do not become steady, and count with their mean "
        f"damage: the least certain one, at {worst.input_torque:.4g} N m, {worst.input_speed:.4g} "
        f"rad/s and {worst.oil_temperature - 273.15:.4g} degC, within +- "
        f"{100.0 * worst.interval:.2g} % (95 %)"
    )


def damage_of(twin: Twin, duration: float, **reached: float) -> Array:
    """Damage of the next seconds of a run.

    Args:
        twin: the run, which advances.
        duration: [s].
        reached: what is given at the shafts at the end, see `Twin.advance`.

    Returns:
        Miner sums, (parts,).
    """
    windows, total = math.ceil(duration / LONGEST), np.zeros(1)
    for _ in range(windows):
        counted = twin.advance(duration / windows, **reached).damage
        assert counted is not None  # the scene has its section `durability`
        total = total + counted.damage
    return np.asarray(total)


def _same(last: Array, now: Array) -> bool:
    counted = np.maximum(last, now) > NEGLIGIBLE * now.max()
    return bool(np.all(np.abs(now - last)[counted] <= SAME * now[counted]))


def _mean_of(blocks: Array) -> SteadyDamage:
    """The mean of blocks, (blocks, parts), with its interval by the means of batches.

    Neighbouring blocks are correlated, so the scatter of single ones would be too small. What still
    decays differs from the first batch to the last one.
    """
    from scipy.stats import t as student

    mean = blocks.mean(axis=0)
    batches = blocks.reshape(BATCHES, -1, len(mean)).mean(axis=1)
    error = batches.std(axis=0, ddof=1) / math.sqrt(BATCHES)
    width = student.ppf(0.5 + 0.5 * CONFIDENCE, BATCHES - 1) * error
    width = np.maximum(width, np.abs(batches[-1] - batches[0]))
    return SteadyDamage(mean, np.divide(width, mean, np.zeros_like(mean), where=mean > 0.0))
