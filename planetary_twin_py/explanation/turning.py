"""Warnings about runs that are too short for means, or turn at another speed than requested."""

from __future__ import annotations

import math
from collections.abc import Iterator

from ..gearset.kinematics import mesh_frequency
from ..model.layout import Layout
from ..run.result import Result
from ..scene import Scene
from ..statics.error_turns import WHOLE_TURN, fewest_turns
from ..studies.turning import (
    ADVICE,
    MANY,
    PARTIAL,
    STANDSTILL,
    WHOLE,
    off_speed,
    part_counts,
    speed_share,
)

SHORT = 0.1  # [s]
LONG = 10.0  # [s]


def turning_warnings(scene: Scene, run: Result) -> Iterator[str]:
    """Warnings about the mesh frequency of a run.

    Returns:
        A sentence if the run covers less than a mesh cycle, or only a few and a part of one,
        another if its mean speed is not that of the operating point, another if it covers a part
        of the turn of an error that changes load shares. Nothing where the gears are to stand
        still.
    """
    wanted = Layout(scene).mesh_frequency
    if not wanted > STANDSTILL:
        return
    speeds = dict(zip(run.bodies, run.mean_speed.tolist(), strict=True))
    frequency = mesh_frequency(scene.gearset.tooth_numbers, speeds["sun"], speeds["carrier"])
    share = speed_share(scene, frequency)
    if frequency * run.duration < WHOLE:
        line = (
            f"the run covers {frequency * run.duration:.2g} of a mesh cycle: means depend on where "
            f"the teeth are; a mesh cycle takes {1.0 / wanted:.3g} s at the operating point"
        )
        turned = f", and the gears turn at {share:.3g} times its speed on average, because {ADVICE}"
        yield line + turned if off_speed(share) else line
    elif off_speed(share):
        yield (
            f"the gears turn at {share:.3g} of the speed of the operating point on average, "
            f"because {ADVICE}"
        )
    elif part_counts(cycles := wanted * run.duration):
        whole = math.ceil(cycles)
        fewer = f"{whole / wanted:.5g} s ({whole} cycles), or " if whole < MANY else ""
        yield (
            f"duration = {run.duration:g} s is {cycles:.3g} mesh cycles: {PARTIAL}; use "
            f"{fewer}{MANY / wanted:.4g} s and more"
        )
    if run.axes is not None:
        cycles, carrier = frequency * run.duration, abs(speeds["carrier"]) * run.duration
        yield from _part_of_a_turn(scene, cycles, carrier / (2.0 * math.pi), run.duration)


def _part_of_a_turn(scene: Scene, cycles: float, carrier: float, duration: float) -> Iterator[str]:
    """A warning if an error covers only a part of its turn, by mesh cycles and carrier turns."""
    error = fewest_turns(scene, cycles, carrier)
    if error is None or error.turns >= WHOLE_TURN:
        return
    longer = f"use {duration / error.turns:.4g} s and more, or " if error.turns else ""
    yield (
        f"{error.field} changes the load shares over a turn, but the run covers {error.turns:.2g} "
        f"of one: load shares and their largest one are those of this part; {longer}see "
        "load-sharing, which covers all of it"
    )


def duration_for_means(scene: Scene) -> float:
    """A short duration [s] whose means do not depend on where the teeth are.

    It is `SHORT`, or as many whole mesh cycles as take longer; `SHORT` also if one takes longer
    than `LONG`.
    """
    frequency = Layout(scene).mesh_frequency
    cycles = frequency * SHORT
    if frequency < 1.0 / LONG or not part_counts(cycles):
        return SHORT
    return math.ceil(cycles) / frequency
