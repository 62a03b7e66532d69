"""Hertz pressure of the teeth, and the pressure up to which laws of friction are in use."""

from __future__ import annotations

import math

from .._core import half_width
from ..lubrication.hertz import contact_modulus
from ..run.result import Result
from ..scene import Scene
from ..units.catalogue import SIDES, side_title
from .mesh_loads import mesh_loads

LARGEST = 2e9
"""Largest pressure of the friction laws [Pa]: that up to which docs/lubrication.md compares them. A
line contact yields at 1.67 times the yield stress (Johnson 1985, sec. 6.1), hardened steel of 1.2
GPa at 2 GPa."""


def pitch_pressure(scene: Scene, force: float, kind: int) -> float:
    """Largest pressure of one pair at the pitch point, or where its path is nearest to that.

    p = E* b/(2 R) (Johnson 1985, sec. 4.2(c)). A flank's radius of curvature is that of the
    transverse section over cos(beta_b), with the same load per length of their contact lines.

    Args:
        scene: the scene.
        force: force of the mesh [N], not negative.
        kind: 0 for sun-planet meshes, 1 for planet-ring meshes.

    Returns:
        The pressure [Pa].
    """
    gearset, oil = scene.gearset, scene.lubrication
    mesh = gearset.geometry.meshes[kind]
    first, second = mesh.curvatures_at(mesh.path.nearest)
    radius = 1.0 / (1.0 / first + (-1.0 if mesh.internal else 1.0) / second)
    radius /= math.cos(gearset.base_helix)
    modulus = contact_modulus(oil.youngs_modulus, oil.poisson_ratio)
    width = gearset.face_width
    return 0.5 * modulus * half_width(force, radius, width, modulus) / radius


def pressure_warning(scene: Scene, run: Result | None = None) -> str | None:
    """Warn if the force of the meshes presses teeth beyond the laws of friction.

    Args:
        scene: the scene.
        run: its result, whose mean forces count; None: the static forces count.

    Returns:
        A sentence, or None.
    """
    if not scene.lubrication.friction:
        return None
    forces = enumerate(mesh_loads(scene, run))
    pressures = [pitch_pressure(scene, force, kind) for kind, force in forces]
    largest = max(pressures)
    if not largest > LARGEST:
        return None
    side = side_title(SIDES[pressures.index(largest)])
    return (
        f"Hertz pressure = {1e-9 * largest:.3g} GPa in the {side} meshes, one pair at or next "
        f"to the pitch point: no law of friction is compared above {1e-9 * LARGEST:g} GPa, where "
        "hardened steel begins to yield, so friction, losses and efficiency are extrapolated; "
        "reduce the torque, or check gearset.face_width and gearset.module"
    )
