"""What a life depends on that is known least: how teeth enter contact, and strength."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np
from numpy.linalg import norm
from numpy.typing import NDArray

from ..scene import Scene, SceneError
from ..simulation.threads import Threads
from .duty_points import DutyPoints
from .steady_damage import steady_damage, steady_scene

Array = NDArray[np.float64]

STRENGTH = 0.05  # relative change of every strength
PLACES = 1 / 6, 1 / 2, 5 / 6  # of the sum of damage over rising torque, where runs are compared
LONGEST_RAMP = 0.2  # of a scene


class Sensitivity(NamedTuple):
    """A change of the scene and what it makes of a life."""

    change: str
    """In words."""
    life: float
    """Life of the part over that without the change; infinite if it is not damaged any more, NaN if
    direct runs do not damage it."""
    interval: float = 0.0
    """Half the 95 % interval of this ratio over itself; above 0 if a motion does not become
    steady."""


def sensitivities(scene: Scene, points: DutyPoints, damage: Array, part: int) -> list[Sensitivity]:
    """Lives of a part under changes of the scene.

    The damage is compared in direct runs at three operating points, each of which stands for a
    third of the damage.

    Args:
        scene: the gearbox.
        points: of the duty.
        damage: of the part at each of them, (n,).
        part: place of the part.

    Returns:
        A line for each change that the scene allows.

    Raises:
        ValueError: a run fails.
    """
    places = _representative(points, damage)
    there = [points.at(place) for place in places.tolist()]
    changes = [("", {}), *_changes(scene)]
    scenes = []
    names = []
    for name, change in changes:
        try:
            scenes.append([steady_scene(scene, **change, **point) for point in there])
        except SceneError:
            continue  # such as entry under load of helical teeth
        names.append(name)
    runs = [each for group in scenes for each in group]
    found = list(Threads().in_order(steady_damage, runs))
    shape = len(names), len(places)
    damage = np.array([each.per_angle[part] for each in found]).reshape(shape)
    doubt = np.array([each.interval[part] for each in found]).reshape(shape)
    damaged = damage[0] > 0.0  # not where an endless S-N curve ends between map and direct run
    ratios = damage[1:, damaged] / damage[0, damaged]
    errors = ratios * np.hypot(doubt[1:, damaged], doubt[0, damaged])
    return [
        _of_life(name, ratio, error)
        for name, ratio, error in zip(names[1:], ratios, errors, strict=True)
    ]


def _of_life(change: str, ratios: Array, errors: Array) -> Sensitivity:
    """From ratios of damage at the places, and half their 95 % intervals."""
    total = float(ratios.sum())
    if total == 0.0:
        return Sensitivity(change, math.inf if len(ratios) else math.nan)
    return Sensitivity(change, len(ratios) / total, float(norm(errors)) / total)


def _representative(points: DutyPoints, damage: Array) -> NDArray[np.int64]:
    order = np.argsort(np.abs(points.torque), kind="stable")
    reached = np.cumsum(damage[order])
    return np.asarray(order[np.searchsorted(reached, np.array(PLACES) * reached[-1])])


def _changes(scene: Scene) -> Iterator[tuple[str, dict[str, Any]]]:
    mesh = scene.mesh
    entry = {} if mesh.entry == "ramp" else {"mesh.entry": "ramp"}
    for text, factor in (("half", 0.5), ("double", 2.0)):
        ramp = min(factor * mesh.ramp, LONGEST_RAMP)
        if ramp != mesh.ramp:
            yield f"mesh.ramp = {ramp:g} ({text})", {"mesh.ramp": ramp, **entry}
    if mesh.entry == "ramp":
        yield "mesh.entry = loaded", {"mesh.entry": "loaded"}
    for sign in (1.0, -1.0):
        factor = 1.0 + sign * STRENGTH
        yield f"strength {100.0 * sign * STRENGTH:+g} %", _strengths(scene, factor)


def _strengths(scene: Scene, factor: float) -> dict[str, Any]:
    """Strengths of all gears and shafts and ratings of all bearings, times a factor."""
    assert scene.durability is not None
    section = scene.durability.model_dump()
    for gear in ("sun", "planet", "ring"):
        for name in ("flank", "root"):
            section["material"][gear][name] *= factor
    for bearing in section["bearings"].values():
        if bearing is not None:
            bearing["rating"] *= factor
    for shaft in section["shafts"].values():
        if shaft is not None:
            shaft["range"] *= factor
    return {"durability": section}
