"""Loads of pairs in a run with vibration, over those in static equilibrium with the same mean."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ...model.gearbox import Gearbox
from ...model.pair_loads import pair_loads
from ...run.result import Result
from ...scene import Scene
from ...simulation.simulate import simulate
from .flanks import Depths, Flanks

Array = NDArray[np.float64]

CYCLES, SETTLING = 50, 50  # mesh cycles of a run, and before it
SAMPLES = 200  # per mesh cycle
LEAST_SETTLING = 0.02  # [s]
LIGHT = 1e-12  # of the mesh force: a pair with a lower static load has the factor 1


def load_factors(
    scene: Scene, flanks: tuple[Flanks, ...], depths: tuple[Depths, ...]
) -> list[Array]:
    """Factors on the loads of the pairs of each kind of mesh at its grid, [(points,)].

    They are means over planets and passages of the tooth pairs; parted flanks carry no load.

    Args:
        scene: scene with the wear of `depths`; its dynamics vibrate.
        flanks: of both kinds of mesh.
        depths: their wear.
    """
    frequency = flanks[0].frequency
    settling = max(SETTLING / frequency, LEAST_SETTLING)
    run = simulate(scene, CYCLES / frequency, SAMPLES * frequency, settling=settling)
    gearbox = Gearbox(scene)
    return [_factor(gearbox, run, each, worn) for each, worn in zip(flanks, depths, strict=True)]


def _factor(gearbox: Gearbox, run: Result, flanks: Flanks, depths: Depths) -> Array:
    planets, position = gearbox.scene.gearset.planets, flanks.position
    pairs = flanks.pairs.worn(position, depths.first + depths.second)
    sums, count, means = np.zeros(len(position)), 0, []
    angle = dict(zip(run.bodies, run.angle.T, strict=True))
    for mesh in range(flanks.kind * planets, (flanks.kind + 1) * planets):
        force = run.mesh_force[:, mesh]
        means.append(abs(float(force.mean())))
        place = pair_loads(gearbox, mesh, angle, force).position[:, 0]
        cycle = np.unwrap(place, period=1.0)
        order = np.argsort(cycle)
        cycle, force = cycle[order], force[order] * np.sign(force.mean())
        first, last = cycle[0] - position[0], cycle[-1] - position[-1]
        for passage in range(int(np.ceil(first)), int(np.floor(last)) + 1):
            there = np.interp(passage + position, cycle, force)
            load = pairs.at(position, np.maximum(there, LIGHT * means[-1])).load
            sums, count = sums + np.where(there > 0.0, load, 0.0), count + 1
    mean = float(np.mean(means))
    static = pairs.at(position, mean).load
    loaded = static > LIGHT * mean
    return np.divide(sums / count, static, out=np.ones(len(position)), where=loaded)
