"""From a duty to damage, lives and what they are worth."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Mapping

import numpy as np
from numpy.typing import NDArray

from ..scene import Scene
from ..scene.given import check_scene
from .ageing import Ageing
from .damage_map import DamageMap, make_damage_map
from .duty_blocks import blocks_of
from .duty_points import DutyPoints, compensated, covered_by, damage_of_points, points_of
from .duty_remarks import map_remarks, remarks_of
from .duty_result import DutyLife, Equivalent
from .duty_table import Duty
from .excerpts import map_error
from .load_distribution import LoadDistribution, equivalent_torque, load_distribution
from .passages import passages_per_turn
from .remaining_life import remaining_life
from .sensitivity import Sensitivity, sensitivities
from .shaft_cycles import shaft_damage

Array = NDArray[np.float64]
Report = Callable[[str, int, int], None]
"""Called with what is at work, how much of it is done, and the whole."""

EXCERPTS = 16  # direct runs by which the map is judged
SMALLER = 0.98  # of all torques, for the exponent of damage over torque


def duty_life(
    scene: Scene,
    duty: Duty,
    repeat: float | None = None,
    reached: Mapping[str, float] | None = None,
    block: float | None = None,
    excerpts: int = EXCERPTS,
    seed: int = 0,
    report: Report | None = None,
) -> DutyLife:
    """Damage of a duty, and how long the parts of a gearbox live under it.

    Steady runs with the dynamics of the scene give the damage over torque, speed and oil
    temperature, on all cores. The sum over the duty is after Palmgren (1924) and Miner (1945). The
    error of this map is measured by direct runs of excerpts of the duty.

    Args:
        scene: the gearbox with its section `durability`, with one input.
        duty: torque, speed and oil temperature, see `read_duty`.
        repeat: time over which the duty is repeated [s]; None: once.
        reached: Miner sums so far, by part, such as those of a state file; None: new.
        block: length of the blocks of a duty in time, such as days or missions, which may come in
            any order [s]; None: a day, if the duty has two of them.
        excerpts: direct runs by which the map is judged, at least 2.
        seed: of the choice of excerpts, and of the remaining life.
        report: called with what is at work, how much of it is done, and the whole.

    Returns:
        Damage, lives and their uncertainty.

    Raises:
        SceneError: the scene has two inputs or no section `durability`.
        ValueError: an argument or a row is out of range, or a run fails.
    """
    began = time.process_time()
    check_scene(scene)
    _check(repeat, excerpts)
    points = points_of(scene, duty)
    table = make_damage_map(scene, covered_by(points))
    table.compute(*points[:3], _at("runs", report))
    error = map_error(scene, table, duty, points, excerpts, seed, _at("excerpts", report))
    rows, unordered = _damage_of_rows(scene, table, duty, points)
    ageing = Ageing(scene, table.parts, compensated(rows) / duty.duration, reached)
    total = _total(duty, repeat)
    scale = total / duty.duration
    blocks, unknown = blocks_of(duty, rows, block)
    equivalent = _equivalent(scene, table, points, ageing.first_level, scale)
    reliability, tenth = ageing.failures(total)
    return DutyLife(
        parts=table.parts,
        time=total,
        damage=scale * compensated(rows),
        life=ageing.life,
        passages=scale * _passages(scene, points),
        first=_name(table.parts, ageing.first),
        reliability=reliability,
        tenth=tenth,
        remaining=remaining_life(blocks, ageing.scatter, ageing.reached, seed),
        equivalent=equivalent,
        loads=_scaled(load_distribution(duty), scale),
        error=error,
        sensitivity=_sensitivity(scene, table, points, ageing.first_level),
        runs=table.runs,
        processor=time.process_time() - began,
        remarks=(
            *duty.remarks,
            *remarks_of(scene, duty, equivalent.exponent),
            *map_remarks(table, error, equivalent.part),
            *unordered,
            *unknown,
        ),
        reached=ageing.reached,
        unsteady=table.unsteady,
    )


def _damage_of_rows(
    scene: Scene, table: DamageMap, duty: Duty, points: DutyPoints
) -> tuple[Array, tuple[str, ...]]:
    """Miner sums of each row, (rows, parts), and what is missing in them.

    The cycles of the torque from row to row are spread over all rows, as they close anywhere.
    """
    rows = damage_of_points(table, points, len(duty.held))
    shafts, unordered = shaft_damage(scene, duty)
    return rows + np.multiply.outer(duty.held / duty.duration, shafts), unordered


def _sensitivity(
    scene: Scene, table: DamageMap, points: DutyPoints, part: int | None
) -> list[Sensitivity]:
    if part is None:
        return []
    return sensitivities(scene, points, _at_points(table, points, part), part)


def _name(parts: tuple[str, ...], place: int | None) -> str:
    return "" if place is None else parts[place]


def _check(repeat: float | None, excerpts: int) -> None:
    if repeat is not None and not (math.isfinite(repeat) and repeat > 0.0):
        raise ValueError(f"repeat = {repeat!r} s: must be above 0 and finite")
    if excerpts < 2:
        raise ValueError(f"excerpts = {excerpts!r}: must be at least 2")


def _at(what: str, report: Report | None) -> Callable[[int, int], None] | None:
    if report is None:
        return None
    return lambda done, whole: report(what, done, whole)


def _total(duty: Duty, repeat: float | None) -> float:
    if repeat is not None:
        return repeat
    if duty.shares:
        raise ValueError("repeat: required, as the duty has shares of the time and no duration")
    return duty.duration


def _equivalent(
    scene: Scene, table: DamageMap, points: DutyPoints, part: int | None, scale: float
) -> Equivalent:
    """The constant torque of a part; the exponent is that of its sum over all torques."""
    turns = scale * float(points.turns.sum())
    if part is None:
        return Equivalent("", 0.0, math.nan, turns, 0.0)
    here = _at_points(table, points, part)
    lighter = _at_points(table, points._replace(torque=SMALLER * points.torque), part)
    loaded, goes_on = here > 0.0, lighter > 0.0  # an endless S-N curve may end between both
    if not goes_on.any():
        return Equivalent(table.parts[part], math.nan, math.nan, turns, math.nan)
    sums = math.fsum(lighter[goes_on]), math.fsum(here[goes_on])
    exponent = math.log(sums[0] / sums[1]) / math.log(SMALLER)
    torque = equivalent_torque(points.torque[loaded], scale * points.turns[loaded], exponent, turns)
    nominal = abs(scene.operating_point.input_torque)
    factor = torque / nominal if nominal else math.nan
    return Equivalent(table.parts[part], torque, exponent, turns, factor)


def _at_points(table: DamageMap, points: DutyPoints, part: int) -> Array:
    """Damage of a part at each point of the duty, (n,)."""
    return np.asarray(table.rates(*points[:3])[:, part] * points.held)


def _passages(scene: Scene, points: DutyPoints) -> Array:
    """Passages of each tooth in a duty, (parts,)."""
    forwards = math.fsum(points.turns[points.torque > 0.0])
    backwards = math.fsum(points.turns[points.torque < 0.0])
    per_turn = passages_per_turn(scene).values()
    return np.array(
        [float(drive) * forwards + float(coast) * backwards for drive, coast in per_turn]
    )


def _scaled(loads: LoadDistribution, scale: float) -> LoadDistribution:
    return loads._replace(duration=scale * loads.duration, turns=scale * loads.turns)
