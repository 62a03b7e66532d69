"""Warnings about runs that are too short for means, or turn at another speed than asked for."""

from __future__ import annotations

import math
from collections.abc import Iterator

from ..dynamics.bodies import rigid_ratios
from ..gearset.kinematics import mesh_frequency
from ..result import Result
from ..scene import Scene

ALLOWED = 0.05  # relative deviation of the mean speed
WHOLE = 0.99  # part of a mesh cycle that counts as one: vibration delays gears by less
_STANDSTILL = 1e-6  # [Hz] of the mesh


def turning_warnings(scene: Scene, run: Result) -> Iterator[str]:
    """Warnings about the mesh frequency of a run.

    Args:
        scene: the scene.
        run: its result.

    Returns:
        A sentence if the run covers less than a mesh cycle, another if its mean speed is not that
        of the operating point. None where the gears are to stand still.
    """
    teeth, ratios = scene.gearset.tooth_numbers, rigid_ratios(scene)
    point = scene.operating_point
    inputs = point.input_speed, point.second_input_speed
    sun, carrier = (
        sum(float(ratio) * speed for ratio, speed in zip(ratios[member], inputs, strict=False))
        for member in ("sun", "carrier")
    )
    wanted = mesh_frequency(teeth, sun, carrier)
    if not wanted > _STANDSTILL:
        return
    speeds = dict(zip(run.bodies, run.mean_speed.tolist(), strict=True))
    found = mesh_frequency(teeth, speeds["sun"], speeds["carrier"])
    if found * run.duration < WHOLE:
        yield (
            f"the run covers {found * run.duration:.2g} of a mesh cycle: means depend on where the "
            f"teeth are; a mesh cycle takes {1.0 / wanted:.3g} s"
        )
    elif scene.drive.speed_control.start_speed is None and not math.isclose(
        found, wanted, rel_tol=ALLOWED
    ):
        yield (
            f"the gears turn at {found / wanted:.3g} of the speed of the operating point on "
            "average, because the speed loop has not settled or yields to the meshes: exclude more "
            "with --settling, simulate longer, or raise drive.speed_control.bandwidth"
        )
