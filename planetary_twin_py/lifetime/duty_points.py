"""Operating points of a duty: its rows, spread by the scatter of the torque within them."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..scene import Scene
from .damage_map import SLOWEST, DamageMap
from .duty_table import STD, Duty
from .map_axes import MapRange

Array = NDArray[np.float64]

# Nodes and weights of a normal distribution (Gauss and Hermite): powers up to 13 are exact.
_NODES, _WEIGHTS = np.polynomial.hermite_e.hermegauss(7)
_WEIGHTS = _WEIGHTS / math.sqrt(2.0 * math.pi)
PART = 1 << 16  # rows whose damage is summed at a time


class DutyPoints(NamedTuple):
    """Operating points and how long they hold."""

    torque: Array
    """Input torque [N m], (n,)."""
    speed: Array
    """Input speed [rad/s], (n,)."""
    temperature: Array
    """Oil temperature [K], (n,)."""
    held: Array
    """Time at each [s], (n,)."""
    row: NDArray[np.int64]
    """Row of the duty, (n,)."""

    @property
    def turns(self) -> Array:
        """Turns of the input, in either direction, (n,)."""
        return np.asarray(np.abs(self.speed) * self.held / (2.0 * math.pi))

    def at(self, place: int) -> dict[str, float]:
        """One of the points, by the names of its quantities."""
        names = "input_torque", "input_speed", "oil_temperature"
        return {name: float(values[place]) for name, values in zip(names, self[:3], strict=True)}

    def take(self, chosen: NDArray[np.int64]) -> DutyPoints:
        """Some of the points."""
        torque, speed, heat, held = (values[chosen] for values in self[:4])
        return DutyPoints(torque, speed, heat, held, self.row[chosen])


def points_of(scene: Scene, duty: Duty) -> DutyPoints:
    """The operating points of a duty.

    A row whose torque scatters becomes seven points of the normal distribution.

    Args:
        scene: gives the oil temperature if the duty does not.
        duty: the rows.

    Returns:
        The points.

    Raises:
        ValueError: a value is outside the limits of the scene.
    """
    columns = duty.columns
    torque, speed = columns["input_torque"], columns["input_speed"]
    oil = np.full(len(torque), scene.operating_point.oil_temperature)
    oil = columns.get("oil_temperature", oil)
    row = np.arange(len(torque))
    points = DutyPoints(torque, speed, oil, duty.held, row)
    if (spread := columns.get(STD)) is not None:
        torques = torque + np.multiply.outer(_NODES, spread)
        held = np.multiply.outer(_WEIGHTS, duty.held)
        copies = len(_NODES)
        speeds, heat = np.tile(speed, copies), np.tile(oil, copies)
        points = DutyPoints(torques.ravel(), speeds, heat, held.ravel(), np.tile(row, copies))
    _check(scene, points, spread is not None)
    return points


def _check(scene: Scene, points: DutyPoints, scatters: bool) -> None:
    for name, values in (
        ("input_torque", points.torque),
        ("input_speed", points.speed),
        ("oil_temperature", points.temperature),
    ):
        allowed = scene.tunables[name]
        wrong = (values < allowed.minimum) | (values > allowed.maximum)
        for n in np.flatnonzero(wrong)[:1]:
            reach = " with its scatter" if scatters and name == "input_torque" else ""
            raise ValueError(
                f"row {points.row[n] + 1}: {name}{reach} = {values[n]:.6g} {allowed.unit}: "
                f"{allowed.range}; units are stated in the headings, such as speed [rpm]"
            )


def covered_by(points: DutyPoints) -> MapRange:
    """What a map must cover for a duty.

    Args:
        points: of the duty.

    Returns:
        The range; speeds far below the highest have the damage per turn of its lower end.

    Raises:
        ValueError: the gearbox never turns under load.
    """
    working = (points.torque != 0.0) & (points.speed != 0.0) & (points.held > 0.0)
    if not working.any():
        raise ValueError("torque, speed: the gearbox never turns under a torque")
    torque, speed, heat = (np.abs(values[working]) for values in points[:3])
    fastest = float(speed.max())
    slowest = max(float(speed.min()), SLOWEST * fastest)
    return MapRange(float(torque.max()), (slowest, fastest), (float(heat.min()), float(heat.max())))


def damage_of_points(table: DamageMap, points: DutyPoints, rows: int) -> Array:
    """Damage of each row of a duty.

    Args:
        table: the map.
        points: of the duty.
        rows: number of rows.

    Returns:
        Miner sums, (rows, parts).
    """
    found = np.zeros((rows, len(table.parts)))
    for first in range(0, len(points.held), PART):
        some = points.take(np.arange(first, min(first + PART, len(points.held))))
        rates = table.rates(some.torque, some.speed, some.temperature)
        np.add.at(found, some.row, rates * some.held[:, np.newaxis])
    return found


def compensated(rows: Array) -> Array:
    """Sums over rows without rounding error, (parts,).

    Args:
        rows: (rows, parts).
    """
    return np.array([math.fsum(column) for column in rows.T])
