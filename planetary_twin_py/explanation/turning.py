"""Warnings about runs that are too short for means, or turn at another speed than asked for."""

from __future__ import annotations

from collections.abc import Iterator

from ..gearset.kinematics import mesh_frequency
from ..result import Result
from ..scene import Scene
from ..studies.turning import (
    ADVICE,
    STANDSTILL,
    WHOLE,
    off_speed,
    speed_share,
    wanted_mesh_frequency,
)


def turning_warnings(scene: Scene, run: Result) -> Iterator[str]:
    """Warnings about the mesh frequency of a run.

    Args:
        scene: the scene.
        run: its result.

    Returns:
        A sentence if the run covers less than a mesh cycle, another if its mean speed is not that
        of the operating point. Nothing where the gears are to stand still.
    """
    wanted = wanted_mesh_frequency(scene)
    if not wanted > STANDSTILL:
        return
    speeds = dict(zip(run.bodies, run.mean_speed.tolist(), strict=True))
    frequency = mesh_frequency(scene.gearset.tooth_numbers, speeds["sun"], speeds["carrier"])
    if frequency * run.duration < WHOLE:
        yield (
            f"the run covers {frequency * run.duration:.2g} of a mesh cycle: means depend on where "
            f"the teeth are; a mesh cycle takes {1.0 / wanted:.3g} s"
        )
    elif off_speed(share := speed_share(scene, frequency)):
        yield (
            f"the gears turn at {share:.3g} of the speed of the operating point on average, "
            f"because {ADVICE}"
        )
