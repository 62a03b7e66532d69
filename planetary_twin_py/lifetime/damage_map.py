"""Damage of the parts of a gearbox over torque, speed and oil temperature: a table of runs."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..durability.parts import part_names
from ..run.limits import RunawayError
from ..scene import TUNABLES, Scene, SceneError
from ..scene.given import check_scene
from ..simulation.threads import Threads
from .equivalent_stress import EquivalentStress
from .map_axes import ROUNDING, MapAxes, MapRange, Node
from .steady_damage import SteadyDamage, Unsteady, steady_damage, steady_scene

Array = NDArray[np.float64]

SLOWEST = 0.03  # share of the largest speed from which on there are nodes
HEATING = 20.0  # [K] around the temperature of a scene
COLDEST, HOTTEST = TUNABLES["oil_temperature"].minimum, TUNABLES["oil_temperature"].maximum
HIGHEST_TORQUE, HIGHEST_SPEED = 1.6, 1.5  # multiples of those of a scene
CHUNK = 4096  # points at a time


class DamageMap:
    """Rates of damage, interpolated in a table whose points are computed when they are needed.

    Interpolated is the logarithm of the damage over the angle that the input turns, of teeth as an
    equivalent stress, by cubics in the logarithms of torque and speed and in temperature. Below the
    table, the stress is a power of the torque, and the damage of a turn that of the lowest speed.

    Args:
        scene: see `make_damage_map`.
        covered: see `make_damage_map`.
    """

    def __init__(self, scene: Scene, covered: MapRange) -> None:
        self.parts = part_names(scene)
        """Names, see `durability.parts`."""
        self.range = covered
        self._stress = EquivalentStress(scene)
        self._scene = self._stress.falling
        self._axes = MapAxes(covered)
        self._table = np.full((*self._axes.shape, len(self.parts)), math.nan)
        """Miner sums over angle of the input [1/rad]; NaN where they are not computed yet."""
        self._smooth = self._table.copy()
        self._unsteady: list[Unsteady] = []

    @property
    def runs(self) -> int:
        """Runs that were simulated so far."""
        return int(np.count_nonzero(~np.isnan(self._table[..., 0])))

    @property
    def unsteady(self) -> tuple[Unsteady, ...]:
        """Runs whose motion does not become steady: their mean damage counts."""
        return tuple(sorted(self._unsteady))

    @property
    def extrapolated(self) -> tuple[str, ...]:
        """Parts of which a run has a stress above the first point of the S-N curve."""
        found = self._stress.beyond(self._smooth.reshape(-1, len(self.parts)))
        return tuple(self.parts[place] for place in found)

    def outside(
        self, torque: ArrayLike, speed: ArrayLike, temperature: ArrayLike
    ) -> NDArray[np.bool_]:
        """Whether the map does not cover operating points, (...); arguments as of `rates`."""
        torque, speed, temperature = np.broadcast_arrays(torque, speed, temperature)
        most, (_, fastest), (cold, hot) = self.range
        inside = (np.abs(torque) <= most * (1.0 + ROUNDING)) & (
            np.abs(speed) <= fastest * (1.0 + ROUNDING)
        )
        slack = ROUNDING * hot
        return np.asarray(~(inside & (temperature >= cold - slack) & (temperature <= hot + slack)))

    def rates(self, torque: ArrayLike, speed: ArrayLike, temperature: ArrayLike) -> Array:
        """Rates of damage at operating points.

        Args:
            torque: input torques [N m], of either sign, (...).
            speed: input speeds [rad/s], of either sign, (...).
            temperature: oil temperatures [K], (...).

        Returns:
            Miner sums over time [1/s], (..., parts); 0 without torque or without rotation.

        Raises:
            ValueError: a point is outside the map, or a run of the table fails.
        """
        given = np.broadcast_arrays(
            *(np.asarray(value, dtype=np.float64) for value in (torque, speed, temperature))
        )
        self._check(*given)
        shape, flat = given[0].shape, [value.ravel() for value in given]
        self.compute(flat[0], flat[1], flat[2])
        found = np.zeros((len(flat[0]), len(self.parts)))
        for first in range(0, len(found), CHUNK):
            part = slice(first, first + CHUNK)
            torques, speeds, heat = (value[part] for value in flat)
            moving = np.flatnonzero((torques != 0.0) & (speeds != 0.0))
            per_angle = self._per_angle(torques[moving], speeds[moving], heat[moving])
            found[first + moving] = per_angle * np.abs(speeds[moving])[:, np.newaxis]
        return found.reshape(*shape, len(self.parts))

    def compute(
        self,
        torque: Array,
        speed: Array,
        temperature: Array,
        advance: Callable[[int, int], None] | None = None,
    ) -> None:
        """Compute the nodes that operating points need, on all cores.

        Args:
            torque: input torques [N m], (n,).
            speed: input speeds [rad/s], (n,).
            temperature: oil temperatures [K], (n,).
            advance: called with the number of completed runs and that of all.

        Raises:
            ValueError: a run fails, or a stress is above its S-N curve.
        """
        wanted = self._unknown(torque, speed, temperature)
        for done, (node, found) in enumerate(Threads().run(self._run, wanted), start=1):
            rates = found.per_angle
            self._table[node], self._smooth[node] = rates, self._stress.smooth(rates)
            if found.doubt > 0.0:
                self._unsteady.append(Unsteady(**self._axes.at(node), interval=found.doubt))
            if advance is not None:
                advance(done, len(wanted))

    def _unknown(self, torque: Array, speed: Array, temperature: Array) -> list[Node]:
        moving = (torque != 0.0) & (speed != 0.0)
        torque, speed, temperature = torque[moving], speed[moving], temperature[moving]
        wanted = np.zeros(self._table.shape[:-1], dtype=bool)
        for first in range(0, len(torque), CHUNK):
            part = slice(first, first + CHUNK)
            self._axes.around(torque[part], speed[part], temperature[part]).mark(wanted)
        unknown = wanted & np.isnan(self._table[..., 0])
        return [Node(*map(int, place)) for place in np.argwhere(unknown)]

    def _run(self, node: Node) -> SteadyDamage:
        """Damage over angle at a node."""
        at = self._axes.at(node)
        try:
            return steady_damage(self._scene.replace(**at))
        except (ValueError, RunawayError) as reason:
            raise ValueError(
                f"input_torque = {at['input_torque']:.4g} N m, input_speed = "
                f"{at['input_speed']:.4g} rad/s, oil_temperature = {at['oil_temperature']:.4g} K: "
                f"{reason}"
            ) from None

    def _per_angle(self, torque: Array, speed: Array, temperature: Array) -> Array:
        """Damage over angle [1/rad], (n, parts)."""
        smooth = np.zeros((len(torque), len(self.parts)))
        straight = smooth.copy()
        for places, weights, linear in self._axes.around(torque, speed, temperature).corners():
            smooth += weights[:, np.newaxis] * self._smooth[places]
            straight += linear[:, np.newaxis] * self._table[places]
        # A part that is not loaded at one of the nodes has no logarithm there.
        empty = np.isnan(smooth)
        found = self._stress.damage(np.where(empty, 0.0, smooth))
        return np.asarray(np.where(empty, np.maximum(straight, 0.0), found))

    def _check(self, torque: Array, speed: Array, temperature: Array) -> None:
        wrong = np.flatnonzero(self.outside(torque, speed, temperature).ravel())
        if not len(wrong):
            return
        at = [float(value.ravel()[wrong[0]]) for value in (torque, speed, temperature)]
        most, (_, fastest), (cold, hot) = self.range
        for name, value, low, high, unit in (
            ("input_torque", at[0], -most, most, "N m"),
            ("input_speed", at[1], -fastest, fastest, "rad/s"),
            ("oil_temperature", at[2], cold, hot, "K"),
        ):
            if not low <= value <= high:
                raise ValueError(
                    f"{name} = {value:.6g} {unit}: must be within {low:.6g} and {high:.6g} {unit}, "
                    "which the map of damage covers"
                )


def make_damage_map(scene: Scene, covered: MapRange | None = None) -> DamageMap:
    """The map of a scene with its section `durability`.

    Args:
        scene: scene of the gearbox, with one input.
        covered: what it covers; None is 1.6 times the torque of the scene within its limit, 0.03 to
            1.5 times its speed, and 20 K around its oil temperature.

    Returns:
        The map; nothing is computed yet.

    Raises:
        SceneError: the scene has two inputs, no section `durability`, or no torque or speed.
    """
    check_scene(scene)
    if scene.durability is None:
        raise SceneError("durability: missing; the scene needs this section for damage")
    if scene.drive.second_input is not None:
        raise SceneError("drive.second_input: a differential has no map of damage")
    return DamageMap(steady_scene(scene), range_of(scene) if covered is None else covered)


def range_of(scene: Scene) -> MapRange:
    """What the map of a scene covers if nothing is said; see `make_damage_map`.

    Args:
        scene: the gearbox.

    Raises:
        SceneError: the operating point has no torque or no speed.
    """
    point, drive = scene.operating_point, scene.drive
    for name in ("input_torque", "input_speed"):
        if getattr(point, name) == 0.0:
            raise SceneError(f"{name} = 0: must be other than 0, as the map of damage is around it")
    fastest = min(HIGHEST_SPEED * abs(point.input_speed), drive.speed_limit)
    heat = point.oil_temperature
    return MapRange(
        min(HIGHEST_TORQUE * abs(point.input_torque), drive.torque_limit),
        (SLOWEST * fastest, fastest),
        (max(heat - HEATING, COLDEST), min(heat + HEATING, HOTTEST)),
    )
