"""Wear of all flanks over hours of operation, and what it changes."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator

import numpy as np
from numpy.typing import NDArray

from ...model.stiffness_laws import GEARS
from ...scene import Scene
from ...scene.given import check_scene
from ...text.number_check import check_number
from .course import Course, State
from .flanks import Depths
from .measure import static_error, unloaded_gap
from .result import Wear, WornFlank, WornPairs
from .worn_scene import worn_scene

Array = NDArray[np.float64]

LARGEST_DOSE = 1e-2  # [s/Pa], beyond any wear of gears


def wear(
    scene: Scene,
    duration: float,
    vibration: bool = False,
    backlash_change: float | None = None,
    step: float | None = None,
    report: Callable[[float], None] = lambda done: None,
) -> Wear:
    """Wear of all flanks at the operating point of a scene, by its law `durability.wear`.

    Each passage of a point of a flank removes k (F/L) abs(1 - V2/V1) (Archard 1953; Flodin and
    Andersson 1997). The worn profile is missing material of the pairs, which changes how pairs and
    planets share the load, and so the further wear. All teeth of a gear have the same wear.
    Depths are in proportion to the coefficient k, which is known to a power of ten at best: give a
    measured change of the backlash for a depth.

    Args:
        scene: scene with `durability.wear`, spur teeth, a torque and a speed.
        duration: of the operation [s].
        vibration: whether the loads are those of a run with the dynamics of the scene, which is
            repeated as the profile changes; otherwise those of static equilibrium.
        backlash_change: measured over the duration [m], of both kinds of mesh together along the
            line of action; it replaces the coefficient of the scene.
        step: time between two updates of the profile [s]; None: as long as the loads remain stable
            and accurate.
        report: called with the part that is done.

    Returns:
        Profiles, their rates, and the scene with them.

    Raises:
        ValueError: an argument is out of range, the scene lacks what wear needs, or a step is so
            long that the loads of the pairs do not level.
    """
    check_scene(scene)
    check_number("duration", duration, "s")
    if not duration > 0.0:
        raise ValueError(f"duration = {duration!r} s: must be above 0 s")
    _check(scene, vibration)
    course = Course(scene, vibration)
    first, before, forces = course.rates(course.depths), course.depths, course.forces
    law = scene.durability.wear  # type: ignore[union-attr]
    coefficient, steps = law.coefficient, 0  # type: ignore[union-attr]
    if backlash_change is None:
        size = None if step is None else _dose_step(course, coefficient, step)
        for dose in course.steps(coefficient * duration, size):
            steps += 1
            report(dose / (coefficient * duration))
    else:
        if step is not None:
            raise ValueError("step: must be none with a measured backlash_change")
        dose, steps = _fitted_dose(course, backlash_change, report)
        coefficient = dose / duration
    last = course.rates(course.depths)
    return Wear(
        worn_scene(scene, course.flanks, course.depths),
        duration,
        coefficient,
        backlash_change is not None,
        tuple(_worn_flanks(course, before, first, last, coefficient)),
        (
            _worn_pairs(course, 0, before[0], forces),
            _worn_pairs(course, 1, before[1], forces),
        ),
        steps,
    )


def _check(scene: Scene, vibration: bool) -> None:
    """Refuse a scene that does not wear."""
    if scene.durability is None or scene.durability.wear is None:
        raise ValueError(
            "durability.wear: missing; give its coefficient, e.g. coefficient: 1e-18 1/Pa"
        )
    if scene.gearset.helix_angle != 0.0:
        raise ValueError("gearset.helix_angle: must be 0, as wear is that of spur teeth")
    if scene.mesh.stiffness == "given" and scene.mesh.double_pair_ratio == 1.0:
        raise ValueError(
            "mesh.double_pair_ratio = 1.0: must be above 1, so that pairs share a load"
        )
    point = scene.operating_point
    if point.input_torque == 0.0:
        raise ValueError("input_torque = 0.0: must be other than 0, so that flanks are loaded")
    if vibration and (scene.quasi_static or scene.dynamics == "auto"):
        raise ValueError(f"dynamics = {scene.dynamics!r}: must be one with vibration")


def _dose_step(course: Course, coefficient: float, step: float) -> float:
    check_number("step", step, "s")
    dose = coefficient * step
    if not step > 0.0 or dose > course.longest:
        longest = course.longest / coefficient if coefficient > 0.0 else math.inf
        raise ValueError(
            f"step = {step:g} s: must be above 0 and at most {longest:.4g} s, a tenth of the step "
            "beyond which the loads of the pairs do not level"
        )
    return dose


def _fitted_dose(
    course: Course, wanted: float, report: Callable[[float], None]
) -> tuple[float, int]:
    """Wear until the backlash has grown by a measured change: the dose [s/Pa], and the steps."""
    check_number("backlash_change", wanted, "m")
    if not wanted > 0.0:
        raise ValueError(f"backlash_change = {wanted!r} m: must be above 0 m")
    start = [unloaded_gap(f, d) for f, d in zip(course.flanks, course.depths, strict=True)]
    reached, last, depths = 0.0, 0.0, course.depths
    for count, dose in enumerate(course.steps(LARGEST_DOSE), 1):
        now = [unloaded_gap(f, d) for f, d in zip(course.flanks, course.depths, strict=True)]
        change = sum(now) - sum(start)
        report(min(change / wanted, 1.0))
        if change >= wanted:
            part = (wanted - reached) / (change - reached)
            course.depths = _between(depths, course.depths, part)
            return last + part * (dose - last), count
        reached, last, depths = change, dose, course.depths
    raise ValueError(f"backlash_change = {wanted:g} m: flanks do not wear, as their film is full")


def _between(before: State, after: State, part: float) -> State:
    sun, ring = (
        Depths(*(a + part * (b - a) for a, b in zip(x, y, strict=True)))
        for x, y in zip(before, after, strict=True)
    )
    return sun, ring


def _worn_flanks(
    course: Course, before: State, first: State, last: State, coefficient: float
) -> Iterator[WornFlank]:
    density = course.scene.lubrication.solid_density
    for kind, flanks in enumerate(course.flanks):
        gained = Depths(*(b - a for a, b in zip(before[kind], course.depths[kind], strict=True)))
        volumes = flanks.volumes(gained)
        for side in range(2):
            gear, mate = GEARS[kind][side], GEARS[kind][1 - side]
            yield WornFlank(
                f"planet_{mate}" if gear == "planet" else gear,
                flanks.position,
                gained[side],
                coefficient * first[kind][side],
                coefficient * last[kind][side],
                density * volumes[side],
            )


def _worn_pairs(course: Course, kind: int, before: Depths, first: tuple[Array, Array]) -> WornPairs:
    flanks, after = course.flanks[kind], course.depths[kind]
    forces = first[kind][0], course.forces[kind][0]
    errors = [
        static_error(flanks, depths, force)
        for depths, force in zip((before, after), forces, strict=True)
    ]
    grown = after.first + after.second - before.first - before.second
    return WornPairs(
        unloaded_gap(flanks, after) - unloaded_gap(flanks, before),
        (float(np.ptp(errors[0])), float(np.ptp(errors[1]))),
        float(errors[1].mean() - errors[0].mean()),
        float(grown.max()),
        float(errors[0].mean()),
        course.shares(kind),
    )
