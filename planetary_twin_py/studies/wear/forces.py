"""Forces of the meshes of each planet as a tooth pair passes its path, from a run."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from ...model.gearbox import Gearbox
from ...model.pair_loads import pair_loads
from ...run.quasi_static.engine import QuasiStaticEngine
from ...scene import Scene
from ...scene.faults import is_of_some_teeth
from ...scene.other_dynamics import static_dynamics, under
from ...simulation.simulate import TOLERANCE, simulate
from .flanks import Flanks

Array = NDArray[np.float64]

SAMPLES = 200  # per mesh cycle
CYCLES = 4  # mesh cycles of a run in equilibrium
VIBRATING, SETTLING = 50, 50  # mesh cycles of a run with vibration, and before it
LEAST_SETTLING = 0.02  # [s]
MEMBERS = ("sun", "planet", "ring")


def run_forces(scene: Scene, flanks: Sequence[Flanks], vibration: bool) -> tuple[Array, Array]:
    """Force of the mesh of each planet while a pair is at each position of the grid.

    It is the mean over the passages; parted flanks have no force. Planets whose meshes have other
    phases take turns in carrying more, also without vibration.

    Args:
        scene: the scene with its wear.
        flanks: of both kinds of mesh.
        vibration: whether to run with the dynamics of the scene; otherwise in static equilibrium
            and without friction, so that the speed has no effect.

    Returns:
        Forces of the sun-planet and of the planet-ring meshes [N], (planets, points) each.
    """
    frequency, ahead = flanks[0].frequency, 0.0
    scene = scene.model_copy(update={"durability": None})  # its damage is not requested
    if vibration:
        settling = max(SETTLING / frequency, LEAST_SETTLING)
        run = simulate(scene, VIBRATING / frequency, SAMPLES * frequency, settling=settling)
    else:
        scene = _still(scene)
        cycles = scene.gearset.tooth_numbers.ring if _turns(scene) else CYCLES
        run = simulate(scene, cycles / frequency, SAMPLES * frequency)
        ahead = QuasiStaticEngine(scene, TOLERANCE).ahead
    gearbox, planets = Gearbox(scene), scene.gearset.planets
    angle = dict(zip(run.bodies, run.angle.T, strict=True))
    angle["sun"] = angle["sun"] + 2.0 * math.pi * ahead / scene.gearset.tooth_numbers.sun
    sun, ring = (
        np.array(
            [
                _passing(gearbox, kind * planets + planet, angle, run.mesh_force, each.position)
                for planet in range(planets)
            ]
        )
        for kind, each in enumerate(flanks)
    )
    return sun, ring


def _still(scene: Scene) -> Scene:
    """The scene in static equilibrium without friction, with axes that move as in it."""
    still = under(scene, static_dynamics(scene))
    return scene.replace(**still, **{"lubrication.friction": False})


def _turns(scene: Scene) -> bool:
    """Whether errors of position or form turn with the gears."""
    runout = scene.mesh.runout
    uneven = any(is_of_some_teeth(fault, m) for fault in scene.faults for m in MEMBERS)
    return uneven or scene.errors.of_axes or bool(runout.sun or runout.planet or runout.ring)


def _passing(
    gearbox: Gearbox, mesh: int, angle: Mapping[str, Array], forces: Array, position: Array
) -> Array:
    """Mean force [N] of a mesh while a pair is at positions (points,)."""
    force = forces[:, mesh]
    cycle = np.unwrap(pair_loads(gearbox, mesh, angle, force).position[:, 0], period=1.0)
    order = np.argsort(cycle)
    cycle, force = cycle[order], np.maximum(force[order] * np.sign(force.mean()), 0.0)
    first, last = int(np.ceil(cycle[0] - position[0])), int(np.floor(cycle[-1] - position[-1]))
    passages = np.arange(first, last + 1)[:, None] + position
    return np.asarray(np.interp(passages, cycle, force).mean(axis=0))
