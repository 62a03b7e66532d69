"""From a duty to damage, lives and what they are worth."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Mapping
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..scene import Scene
from ..scene.given import check_scene
from ..text.object_repr import brief
from .damage_map import DamageMap, make_damage_map
from .duty_blocks import blocks_of
from .duty_points import DutyPoints, compensated, covered_by, damage_of_points, points_of
from .duty_remarks import remarks_of
from .duty_table import Duty
from .excerpts import MapError, map_error
from .load_distribution import LoadDistribution, equivalent_torque, load_distribution
from .passages import passages_per_turn
from .reliability import scatter_of, system_quantile, system_reliability
from .remaining_life import RemainingLife, remaining_life
from .sensitivity import Sensitivity, sensitivities
from .shaft_cycles import shaft_damage

Array = NDArray[np.float64]
Report = Callable[[str, int, int], None]
"""Called with what is at work, how much of it is done, and the whole."""

EXCERPTS = 16  # direct runs by which the map is judged
SMALLER = 0.98  # of all torques, for the exponent of damage over torque


class Equivalent(NamedTuple):
    """A constant torque that damages a part as much as the duty."""

    part: str
    """The tooth or bearing with the largest damage; "" without damage."""
    torque: float
    """[N m]"""
    exponent: float
    """m: damage over torque in this duty is proportional to torque^m."""
    turns: float
    """n_eq: turns of the input in the whole time, all under this torque."""
    application_factor: float
    """K_A: this torque over that of the scene; NaN if that is 0."""


class DutyLife(NamedTuple):
    """Damage of a duty and the lives that follow; nothing here is a rating to a standard."""

    parts: tuple[str, ...]
    """Names, see `durability.parts`."""
    time: float
    """Time that the duty lasts with its repetitions [s]."""
    damage: Array
    """Miner sums over this time, without what was there before, (parts,)."""
    life: Array
    """Time until the damage is 1, from new [s], (parts,); infinite without damage. So long live
    99 % of gears and 90 % of rolling bearings."""
    passages: Array
    """Passages of each tooth over this time; 0 of bearings, (parts,)."""
    first: str
    """Part with the shortest life; "" without damage."""
    reliability: float
    """Share of gearboxes in which no part fails in this time."""
    tenth: float
    """Time in which a part fails in 10 % of the gearboxes, from new [s]."""
    remaining: RemainingLife
    """Time until the first part fails, given the damage so far."""
    equivalent: Equivalent
    """Of the tooth or bearing that fails first."""
    loads: LoadDistribution
    """Time and turns at each torque, over the whole time."""
    error: MapError
    """Of the map, measured by direct runs, by part."""
    sensitivity: list[Sensitivity]
    """Of the life of that tooth or bearing."""
    runs: int
    """Runs of the map."""
    processor: float
    """Time of processors that all took [s]."""
    remarks: tuple[str, ...]
    """What is missing or doubtful."""

    def figures(self) -> dict[str, Any]:
        """Results in SI, as JSON has them; None stands for infinite or unknown."""
        by_part = {
            part: {
                "damage": damage,
                "life": _known(life),
                "passages": passages,
                "map_error": _known(mean),
                "map_error_interval": _known(bound),
            }
            for part, damage, life, passages, mean, bound in zip(
                self.parts, self.damage.tolist(), self.life.tolist(), self.passages.tolist(),
                self.error.mean.tolist(), self.error.bound.tolist(), strict=True,
            )
        }  # fmt: skip
        listed = ("time", "first", "reliability", "runs", "processor")
        return {
            **{name: getattr(self, name) for name in listed},
            "tenth": _known(self.tenth),
            "parts": by_part,
            "remaining": {name: _known(v) for name, v in self.remaining._asdict().items()},
            "equivalent": {
                name: v if isinstance(v, str) else _known(v)
                for name, v in self.equivalent._asdict().items()
            },
            "loads": {name: v.tolist() for name, v in self.loads._asdict().items()},
            "excerpts": {"number": self.error.excerpts, "seconds": _known(self.error.seconds)},
            "sensitivity": {each.change: _known(each.life) for each in self.sensitivity},
            "remarks": list(self.remarks),
        }

    def __repr__(self) -> str:
        """One line."""
        return brief(self, f"{self.time:g} s", f"first: {self.first or 'none'}")


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
        repeat: time over which the duty goes on and on [s]; None: once.
        reached: Miner sums so far, by part; None: new.
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
    rows = damage_of_points(table, points, len(duty.held))
    error = map_error(scene, table, duty, points, excerpts, seed, _at("excerpts", report))
    ruling = _ruling(table.parts, compensated(rows))
    shafts, unordered = shaft_damage(scene, duty)
    rows = rows + np.multiply.outer(duty.held / duty.duration, shafts)
    sums = compensated(rows)
    total = _total(duty, repeat)
    scale = total / duty.duration
    equivalent = _equivalent(scene, table, points, ruling, scale)
    blocks, unknown = blocks_of(duty, rows, block)
    with np.errstate(divide="ignore"):
        life = duty.duration / sums
    scatter = [scatter_of(scene, part) for part in table.parts]
    ageing = np.flatnonzero(np.isfinite(life))
    weibulls = [scatter[part].weibull(float(life[part])) for part in ageing]
    at_points = _at_points(table, points, ruling)
    return DutyLife(
        parts=table.parts,
        time=total,
        damage=scale * sums,
        life=life,
        passages=scale * _passages(scene, points),
        first=table.parts[int(np.argmax(sums))] if sums.any() else "",
        reliability=system_reliability(weibulls, total),
        tenth=system_quantile(weibulls, 0.1),
        remaining=remaining_life(blocks, scatter, _reached(table.parts, reached), seed),
        equivalent=equivalent,
        loads=_scaled(load_distribution(duty), scale),
        error=error,
        sensitivity=[] if ruling is None else sensitivities(scene, points, at_points, ruling),
        runs=table.runs,
        processor=time.process_time() - began,
        remarks=(
            *duty.remarks,
            *remarks_of(scene, duty, equivalent.exponent, table.extrapolated),
            *unordered,
            *unknown,
        ),
    )


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


def _ruling(parts: tuple[str, ...], sums: Array) -> int | None:
    """Tooth or bearing with the largest damage; None without damage."""
    levels = np.where([part.endswith("_shaft") for part in parts], 0.0, sums)
    return int(np.argmax(levels)) if levels.any() else None


def _equivalent(
    scene: Scene, table: DamageMap, points: DutyPoints, part: int | None, scale: float
) -> Equivalent:
    """The constant torque of a part; the exponent is that of its sum over all torques."""
    turns = scale * float(points.turns.sum())
    if part is None:
        return Equivalent("", 0.0, math.nan, turns, 0.0)
    here = _at_points(table, points, part)
    lighter = _at_points(table, points._replace(torque=SMALLER * points.torque), part)
    exponent = math.log(math.fsum(lighter) / math.fsum(here)) / math.log(SMALLER)
    loaded = here > 0.0
    torque = equivalent_torque(points.torque[loaded], scale * points.turns[loaded], exponent, turns)
    nominal = abs(scene.operating_point.input_torque)
    factor = torque / nominal if nominal else math.nan
    return Equivalent(table.parts[part], torque, exponent, turns, factor)


def _at_points(table: DamageMap, points: DutyPoints, part: int | None) -> Array:
    """Damage of a part at each point of the duty, (n,)."""
    if part is None:
        return np.zeros(len(points.held))
    return np.asarray(table.rates(*points[:3])[:, part] * points.held)


def _passages(scene: Scene, points: DutyPoints) -> Array:
    """Passages of each tooth in a duty, (parts,)."""
    forwards = math.fsum(points.turns[points.torque > 0.0])
    backwards = math.fsum(points.turns[points.torque < 0.0])
    per_turn = passages_per_turn(scene).values()
    return np.array(
        [float(drive) * forwards + float(coast) * backwards for drive, coast in per_turn]
    )


def _reached(parts: tuple[str, ...], reached: Mapping[str, float] | None) -> Array:
    given = reached or {}
    for name, value in given.items():
        if name not in parts:
            raise ValueError(f"reached: {name!r}: no such part; there are {', '.join(parts)}")
        if not (math.isfinite(value) and value >= 0.0):
            raise ValueError(f"reached: {name} = {value!r}: must be at least 0 and finite")
    return np.array([given.get(part, 0.0) for part in parts])


def _scaled(loads: LoadDistribution, scale: float) -> LoadDistribution:
    return loads._replace(duration=scale * loads.duration, turns=scale * loads.turns)


def _known(value: float) -> float | None:
    return value if math.isfinite(value) else None
