"""Damage of steady running at one operating point."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from ..model.cycle import common_cycles
from ..model.gearbox import Gearbox
from ..run.twin import Twin
from ..scene import Scene

Array = NDArray[np.float64]

TOLERANCE = 1e-4
BLOCK = 10  # mesh cycles that are compared with the next ones
MOST_CYCLES = 5000  # of a block: errors and faults of all gears may meet again only after ages
MOST_BLOCKS = 30
SAME = 2e-3  # relative difference of the damage of two blocks from which on it is steady
NEGLIGIBLE = 1e-6  # of the largest damage: below, a part need not be steady
LONGEST = 50.0  # [s] of a window
FEW = 16  # samples of a block, which nobody reads


def steady_damage(scene: Scene) -> Array:
    """Damage over the angle that the input turns, after transients have decayed.

    Args:
        scene: the gearbox with its operating point; its dynamics are selected and it turns.

    Returns:
        Miner sums over angle [1/rad], (parts,).

    Raises:
        ValueError: a stress is above that of the S-N curve.
        RunawayError: the run exceeds physical limits.
    """
    gearbox = Gearbox(scene)
    speed = abs(scene.operating_point.input_speed)
    period = common_cycles(gearbox.train, gearbox.operation(scene.operating_point))
    cycles = min(period * math.ceil(BLOCK / period), MOST_CYCLES)
    duration = cycles / gearbox.mesh_frequency
    twin = Twin(scene, max(FEW / duration, 1.0), TOLERANCE)
    found: list[Array] = []
    for _ in range(MOST_BLOCKS):
        found.append(damage_of(twin, duration) / (speed * duration))
        if len(found) > 1 and _same(*found[-2:]):
            return found[-1]
    # Of a motion that never repeats, the mean is that of its later half.
    return np.asarray(np.mean(found[len(found) // 2 :], axis=0))


def damage_of(twin: Twin, duration: float, torque: float | None = None) -> Array:
    """Damage of the next seconds of a run.

    Args:
        twin: the run, which advances.
        duration: [s].
        torque: given at the input shaft [N m], reached at the end; None: none is given.

    Returns:
        Miner sums, (parts,).
    """
    windows, total = math.ceil(duration / LONGEST), np.zeros(1)
    for _ in range(windows):
        counted = twin.advance(duration / windows, input_torque=torque).damage
        assert counted is not None  # the scene has its section `durability`
        total = total + counted.damage
    return np.asarray(total)


def _same(last: Array, now: Array) -> bool:
    counted = np.maximum(last, now) > NEGLIGIBLE * now.max()
    return bool(np.all(np.abs(now - last)[counted] <= SAME * now[counted]))
