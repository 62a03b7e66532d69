"""Error of a map of damage over a duty, measured by direct runs of some of its time."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..model.layout import Layout
from ..run.twin import Twin
from ..scene import Scene
from ..simulation.threads import Threads
from .damage_map import DamageMap
from .duty_points import DutyPoints
from .duty_table import Duty
from .steady_damage import CONFIDENCE, TOLERANCE, damage_of, long_run_damage, steady_scene

Array = NDArray[np.float64]

CHANGING = 2.0  # [s] rows up to this are points of a course, longer ones are steady running
LEAST = 1.0  # [s] of an excerpt of a course
CYCLES = 50  # mesh cycles of such an excerpt at least
ROWS = 4  # rows of such an excerpt at least
LEAD = 0.3  # share of an excerpt that is simulated before it, until its start has decayed
STEP = 0.005  # [s] at which the map is read along a course
FEW_RATE = 100.0  # [Hz] of samples that nobody reads
FOLLOWING = {
    "drive.input.port": "torque",
    "drive.output.port": "motion",
    "drive.interpolation": "linear",
}
NEGLIGIBLE = 1e-6  # of the largest damage: below, an excerpt says nothing of a part


class MapError(NamedTuple):
    """Deviation of the map from direct runs, by part, relative to the damage of the duty."""

    mean: Array
    """Damage of the map over that of direct runs, less 1; NaN of parts without damage, (parts,)."""
    bound: Array
    """Half the width of its 95 % interval, from the scatter of the excerpts, (parts,)."""
    excerpts: int
    """Direct runs; 0 without damage."""
    seconds: float
    """Length of each [s]; NaN of steady running at operating points of the duty."""

    @property
    def largest(self) -> Array:
        """Largest error within the interval, (parts,)."""
        return np.asarray(np.abs(self.mean) + self.bound)


class _Window(NamedTuple):
    """Rows of a course that are simulated, with their lead."""

    first: int
    begin: int
    last: int


def map_error(
    scene: Scene,
    table: DamageMap,
    duty: Duty,
    points: DutyPoints,
    count: int,
    seed: int = 0,
    advance: Callable[[int, int], None] | None = None,
) -> MapError:
    """Compare the map with direct runs of excerpts of the duty.

    Excerpts are drawn in proportion to their damage, so that few of them judge the sum. Of a duty
    whose rows hold for seconds, each is steady running at an operating point. Otherwise it is a
    window of the course: torque of the input and speed of the output move linearly from row to row,
    as a machine that controls the speed would lag behind the duty.

    Args:
        scene: the gearbox.
        table: its map.
        duty: the duty.
        points: of the duty.
        count: number of excerpts.
        seed: of their choice.
        advance: called with the number of completed excerpts and that of all.

    Returns:
        The error.

    Raises:
        ValueError: a run fails.
    """
    direct = steady_scene(scene)
    course = is_course(duty)
    damage = table.rates(*points[:3]) * points.held[:, np.newaxis]
    judged = _judged_parts(table.parts, damage, course)
    if not judged.any():
        unknown = np.full(len(table.parts), math.nan)
        return MapError(unknown, unknown, 0, math.nan)
    windows, seconds = (_windows(scene, duty), math.nan) if course else ([], math.nan)
    if course:
        seconds = float(np.mean([duty.held[each.begin : each.last].sum() for each in windows]))
        per_row = np.zeros((len(duty.held), len(table.parts)))
        np.add.at(per_row, points.row, damage)
        damage = np.array([per_row[each.begin : each.last].sum(axis=0) for each in windows])

    def run(place: int) -> tuple[Array, Array]:
        if course:
            return _along(direct, table, duty, points, windows[place])
        return _steady(direct, table, points, place)

    picks, weights = _drawn(damage, judged, count, seed)
    distinct, again = np.unique(picks, return_inverse=True)
    found = np.zeros((len(distinct), 2, len(table.parts)))
    tasks = range(len(distinct))
    for done, (n, both) in enumerate(Threads().run(lambda n: run(int(distinct[n])), tasks), 1):
        found[n] = both
        if advance is not None:
            advance(done, len(distinct))
    return _judged(found[again], weights, len(distinct), seconds)


def _judged_parts(parts: tuple[str, ...], damage: Array, course: bool) -> NDArray[np.bool_]:
    """Parts of which excerpts say something, (parts,)."""
    sums = damage.sum(axis=0)
    ageing = sums > NEGLIGIBLE * sums.max()
    if course:  # the cycles of shafts from row to row are counted apart
        ageing &= ~np.array([part.endswith("_shaft") for part in parts])
    return np.asarray(ageing)


def _drawn(
    damage: Array, judged: NDArray[np.bool_], count: int, seed: int
) -> tuple[NDArray[np.int64], Array]:
    """Places of excerpts, (count,), and what each stands for, (count, parts)."""
    shares = damage / np.maximum(damage.sum(axis=0), np.finfo(float).tiny)
    chances = shares[:, judged].mean(axis=1)
    chances /= chances.sum()
    picks = np.random.default_rng(seed).choice(len(chances), size=count, p=chances)
    return picks, (shares[picks] / chances[picks][:, np.newaxis]) * judged


def is_course(duty: Duty) -> bool:
    """Whether the rows of a duty follow so closely that torque moves from one to the next."""
    return duty.time is not None and float(np.median(duty.held)) <= CHANGING and len(duty.held) > 1


def _judged(ratios: Array, weights: Array, count: int, seconds: float) -> MapError:
    """The error from map and direct damage of each excerpt, (excerpts, 2, parts)."""
    from scipy.stats import t as student

    mapped, direct = ratios[:, 0], ratios[:, 1]
    known = (mapped > 0.0) & (weights > 0.0)
    weights = np.where(known, weights, 0.0)
    with np.errstate(divide="ignore", invalid="ignore"):
        over = np.where(known, direct / mapped, 0.0)
        total = weights.sum(axis=0)
        mean = (weights * over).sum(axis=0) / total
        scatter = np.sqrt((weights**2 * (over - mean) ** 2).sum(axis=0)) / total
        drawn = len(ratios)
        wide = student.ppf(0.5 + 0.5 * CONFIDENCE, max(drawn - 1, 1))
        scatter *= wide * math.sqrt(drawn / max(drawn - 1, 1)) / mean**2
        return MapError(1.0 / mean - 1.0, scatter, count, seconds)


def _steady(scene: Scene, table: DamageMap, points: DutyPoints, place: int) -> tuple[Array, Array]:
    at = points.at(place)
    return table.rates(*at.values()) / abs(at["input_speed"]), long_run_damage(scene.replace(**at))


def _windows(scene: Scene, duty: Duty) -> list[_Window]:
    """Windows into which a course is cut; the first rows are the lead of the first one."""
    speeds = np.abs(duty.columns["input_speed"])
    per_turn = abs(float(Layout(scene).cycles[0])) / (2.0 * math.pi)
    slow = per_turn * float(speeds[speeds > 0.0].mean())
    row = float(np.median(duty.held))
    length = max(LEAST, CYCLES / slow, ROWS * row)
    time = np.concatenate([[0.0], np.cumsum(duty.held)])
    if time[-1] < (1.0 + LEAD) * length:
        length = time[-1] / (1.0 + LEAD)
    count = max(1, int((time[-1] - LEAD * length) // length))
    begins = np.searchsorted(time, LEAD * length + length * np.arange(count))
    lasts = np.searchsorted(time, LEAD * length + length * np.arange(1, count + 1) - 1e-9 * length)
    firsts = np.searchsorted(time, time[begins] - LEAD * length)
    places = zip(firsts, begins, np.minimum(lasts, len(duty.held)), strict=True)
    return [_Window(*map(int, each)) for each in places if each[2] > each[1]]


def _along(
    scene: Scene, table: DamageMap, duty: Duty, points: DutyPoints, window: _Window
) -> tuple[Array, Array]:
    """Damage of a window by the map and by a direct run, (parts,) each."""
    torque, speed = duty.columns["input_torque"], duty.columns["input_speed"]
    heat = points.temperature[np.searchsorted(points.row[: len(torque)], window.begin)]
    ports = {} if scene.quasi_static else FOLLOWING
    start = scene.replace(
        input_torque=float(torque[window.first]),
        input_speed=float(speed[window.first]),
        oil_temperature=float(heat),
        **ports,
    )
    twin = Twin(start, FEW_RATE, TOLERANCE)
    output = Layout(scene).speeds(1.0)["load"]
    mapped, direct = np.zeros(len(table.parts)), np.zeros(len(table.parts))
    for row in range(window.first, window.last):
        held, after = float(duty.held[row]), min(row + 1, len(torque) - 1)
        torques, speeds = _between(torque, row, held), _between(speed, row, held)
        if scene.quasi_static:
            found = _through(twin, torques, speeds, held)
        else:
            reached = {"input_torque": torque[after], "output_speed": output * speed[after]}
            found = damage_of(twin, held, **reached)
        if row >= window.begin:
            direct += found
            mapped += table.rates(torques, speeds, heat).mean(axis=0) * held
    return mapped, direct


def _between(values: Array, row: int, held: float) -> Array:
    """Values of a row, which move linearly to that of the next one, (n,)."""
    parts = max(1, math.ceil(held / STEP))
    share = (np.arange(parts) + 0.5) / parts
    after = values[min(row + 1, len(values) - 1)]
    return np.asarray(values[row] + share * (after - values[row]))


def _through(twin: Twin, torques: Array, speeds: Array, duration: float) -> Array:
    """Damage of equilibria under torques and speeds one after the other, (parts,)."""
    total = np.zeros(1)
    for torque, speed in zip(torques.tolist(), speeds.tolist(), strict=True):
        twin.set(input_torque=torque, input_speed=speed)
        total = total + damage_of(twin, duration / len(torques))
    return total
