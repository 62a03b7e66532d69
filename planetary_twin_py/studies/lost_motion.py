"""Lost-motion test: the output is loaded slowly both ways while the input is held.

The twist of the output against the input, at the members of the gear set and so without couplings,
draws a loop over the torque: backlash, elastic deflection of the teeth, and static friction. Two
figures are those of data sheets of precision gears: lost motion, the twist between small torques of
both senses, each the mean of loading and unloading (3 % of the rated torque is usual), and the
torsional stiffness between half and full torque.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..model.layout import LOAD_MACHINE, Layout
from ..model.stiffness_laws import stiffness_laws
from ..run.twin import Twin
from ..scene import Scene
from ..scene.other_dynamics import under
from ..units.shown import LOST_MOTION

SHARE = 0.03  # of the torque, at which lost motion is measured
LARGE_SHARE = 0.45  # of the torque; a share must be below 0.5
UPPER = 0.5  # of the torque, from which the stiffness is measured
LEVELS = 25  # torques from 0 to the largest
DWELL = 0.01  # [s] from one reading of the twist to the next
READINGS = 4  # the last ones must agree; two may agree by chance in a vibration
FURTHER_READINGS = 100  # at each torque, at most
FREQUENCY = 200.0  # [Hz] of a machine of the bench on the gear set
GEARS = 1000.0  # [Hz] of a gear of the bench on its meshes
CARRIED = 0.1  # mass of the planets on the carrier, over J/r^2 of the carrier
COUPLING = 10.0  # stiffness of its coupling over that of the gear set
MESH_DAMPING = 0.3  # damping ratio of a mesh on the bench
SETTLED = 1e-4  # change between two readings of a twist at rest, over the elastic twist


@dataclass(frozen=True)
class LostMotion:
    """A closed loop of twist over torque, from the largest torque to its opposite and back.

    Where the torque changes its sense, it has two points at torque 0, where flanks part and meet.
    They are not measured, but on the elastic line of their sense through the nearest measured one.
    """

    torque: np.ndarray
    """On the output member [N m], (points,)."""
    twist: np.ndarray
    """Angle of the output member less that of the input member times the ratio [rad], (points,)."""
    settled: bool
    """Whether the twist came to rest at every torque."""
    share: float
    """Part of the largest torque at which lost motion is measured."""
    couplings: float
    """Compliance of the couplings of the scene, at the output with the motor held [rad/(N m)]."""
    resolution: float
    """Change between two readings that is taken for rest: smaller twists are not resolved [rad]."""
    largest_torque: float
    """To which the output was loaded [N m]."""

    def _branches(self) -> tuple[tuple[np.ndarray, np.ndarray], tuple[np.ndarray, np.ndarray]]:
        """Torque and twist of the falling branch, reversed, and of the rising one."""
        turn = int(np.argmin(self.torque))
        falling = self.torque[: turn + 1][::-1], self.twist[: turn + 1][::-1]
        return falling, (self.torque[turn:], self.twist[turn:])

    def _twists_at_small_torque(self) -> np.ndarray:
        """Twist of both branches, (2,), at `share` of the torque and at its opposite, (2, 2)."""
        small = self.share * float(self.torque.max())
        return np.array(
            [[_twist_at(t, *branch) for branch in self._branches()] for t in (small, -small)]
        )

    @property
    def lost_motion(self) -> float:
        """Twist between both senses of `share` of the torque, means of both branches [rad]."""
        forward, backward = self._twists_at_small_torque().mean(axis=1)
        return float(forward - backward)

    @property
    def hysteresis(self) -> float:
        """Distance of both branches at `share` of the torque, mean of both senses [rad].

        It is due to friction alone; at zero torque it would include the backlash.
        """
        return float(np.abs(np.diff(self._twists_at_small_torque(), axis=1)).mean())

    @property
    def hysteresis_resolved(self) -> bool:
        """Whether the hysteresis, a difference of two twists, is larger than their errors."""
        return self.hysteresis > 2.0 * self.resolution

    @property
    def stiffness_by_sense(self) -> tuple[float, float]:
        """Torsional stiffness from half to full torque, positive and negative [N m/rad].

        Other tooth pairs carry in each sense, which planets in phase do not average.
        """
        return _stiffness_by_sense(self.torque, self.twist)

    @property
    def stiffness(self) -> float:
        """Torsional stiffness from half to full torque, mean of both senses [N m/rad]."""
        return 0.5 * sum(self.stiffness_by_sense)

    @property
    def stiffness_with_couplings(self) -> float:
        """Torsional stiffness between motor and load, with the couplings of the scene [N m/rad]."""
        return 1.0 / (1.0 / self.stiffness + self.couplings)

    def lines(self) -> Iterator[tuple[str, str]]:
        """What the loop shows: the heading of each quantity with its unit, and its value."""
        positive, negative = self.stiffness_by_sense
        values = {
            "largest_torque": self.largest_torque,
            "lost_motion": self.lost_motion,
            "hysteresis": self.hysteresis,
            "stiffness": self.stiffness,
            "stiffness_positive": positive,
            "stiffness_negative": negative,
            "stiffness_with_couplings": self.stiffness_with_couplings,
        }
        for name, quantity in LOST_MOTION.items():
            text = f"{quantity.factor * values[name]:.6g}"
            if name == "hysteresis" and not self.hysteresis_resolved:
                bound = self.hysteresis + 2.0 * self.resolution
                text = f"below {quantity.factor * bound:.2g}"
            yield quantity.heading.format(share=100.0 * self.share), text

    def remarks(self) -> Iterator[str]:
        """What makes the loop or its figures uncertain."""
        if not self.settled:
            yield (
                "the twist had not come to rest at some torques: the loop is wider than that of a "
                "slower test"
            )
        if not self.hysteresis_resolved:
            remedy = "this friction is too small for this test"
            if self.share < LARGE_SHARE:  # hysteresis grows with the share, resolution does not
                remedy = f"measure it at a larger --share, up to {LARGE_SHARE:g}"
            yield (
                "the hysteresis is not resolved: twists are read to "
                f"{math.degrees(self.resolution):.2g} deg; {remedy}"
            )

    def figures(self) -> dict[str, Any]:
        """The loop and what follows from it for JSON, in SI."""
        names = (
            "lost_motion", "hysteresis", "hysteresis_resolved", "stiffness", "stiffness_by_sense",
            "stiffness_with_couplings", "settled",
        )  # fmt: skip
        figures = {name: getattr(self, name) for name in names}
        return figures | {"torque": self.torque.tolist(), "twist": self.twist.tolist()}


def _twist_at(value: float, torque: np.ndarray, twist: np.ndarray) -> float:
    """Twist at a torque `value`, on the line through the nearest points of its sense [rad].

    Friction changes the torque on the output, so no point is exactly at `value`. Points of both
    senses have the backlash between them.
    """
    of_its_sense = torque * value > 0.0
    torque, twist = torque[of_its_sense], twist[of_its_sense]
    k = min(max(int(np.searchsorted(torque, value)), 1), len(torque) - 1)
    slope = (twist[k] - twist[k - 1]) / (torque[k] - torque[k - 1])
    return float(twist[k] + slope * (value - torque[k]))


def _stiffness_by_sense(torque: np.ndarray, twist: np.ndarray) -> tuple[float, float]:
    """Stiffness of a loop from half to full torque, positive and negative [N m/rad]."""
    turn = int(np.argmin(torque))
    rising, falling = slice(turn, None), slice(turn + 1)  # they load in their senses
    return (
        _loading_slope(torque[rising], twist[rising]),
        _loading_slope(-torque[falling], -twist[falling]),
    )


def _with_flanks_parted(torque: np.ndarray, twist: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Torque and twist of a loop with both ends of the backlash, at torque 0."""
    positive, negative = _stiffness_by_sense(torque, twist)
    unloaded = twist - torque / np.where(torque > 0.0, positive, negative)
    before = np.flatnonzero(torque[:-1] * torque[1:] < 0.0)
    ends = np.column_stack([before, before + 1]).ravel()
    places = np.repeat(before + 1, 2)
    return np.insert(torque, places, 0.0), np.insert(twist, places, unloaded[ends])


def _loading_slope(torque: np.ndarray, twist: np.ndarray) -> float:
    """Stiffness from half to full torque of a branch, which is positive there [N m/rad]."""
    chosen = torque >= (UPPER - 1e-6) * torque.max()
    return float(np.polyfit(twist[chosen], torque[chosen], 1)[0])


def lost_motion(
    scene: Scene,
    torque: float,
    share: float = SHARE,
    levels: int = LEVELS,
    dwell: float = DWELL,
    tolerance: float = 1e-4,
    report: Callable[[int], None] = lambda done: None,
) -> LostMotion:
    """Load the output from 0 to a torque, to its opposite and back, with the input held.

    The scene is simulated at speed 0, so friction sticks and breaks away by the laws of the scene.
    Machines and couplings are replaced by stiff and well damped ones, which hold the input and come
    to rest between two torques. Inertias are replaced by larger ones, because vibration of light
    gears would require steps of a microsecond. Neither changes the statics. Teeth whose stiffness
    follows the load have that of the largest torque at all torques. Axes are held: bearings, shafts
    and the carrier are rigid.

    Args:
        scene: scene with one input.
        torque: largest torque on the output member [N m], above 0 and at most that of
            drive.torque_limit without losses.
        share: part of it at which lost motion is measured [-], above 0 and below 0.5.
        levels: torques from 0 to the largest.
        dwell: time between two readings of the twist [s].
        tolerance: relative local error tolerance.
        report: called with the number of torques completed since the last call.

    Returns:
        The loop, without the first loading.

    Raises:
        ValueError: torque or share is out of range, or the scene has two inputs.
        RunawayError: a mesh deflects by more than a base pitch.
    """
    if scene.drive.second_input is not None:
        raise ValueError("drive.second_input: must be none for a lost-motion test")
    if not 0.0 < share < 0.5:
        raise ValueError(f"share = {share!r}: must be above 0 and below 0.5")
    per_input = float(Layout(scene).machine_torques[LOAD_MACHINE])
    limit = scene.drive.torque_limit
    if not 0.0 < torque <= limit * abs(per_input):
        raise ValueError(
            f"torque = {torque!r} N m: must be above 0 and at most {limit * abs(per_input):g} N m, "
            "from drive.torque_limit"
        )
    scene = scene.replace(input_torque=float(np.clip(torque / per_input, -limit, limit)))
    bench = _on_bench(scene)
    twin = Twin(bench, tolerance=tolerance)
    # Not at torque 0, at which the output may rest anywhere in its backlash.
    loading = np.unique([share * torque, *np.linspace(0.0, torque, levels + 1)[1:]])
    steps = np.concatenate([loading, loading[-2::-1], -loading, -loading[-2::-1], loading])
    resolution = SETTLED * torque / _stiffness(scene, scene.drive.output.member)
    loop, largest_motion = [], 0.0
    for step in steps:
        twin.set(input_torque=float(np.clip(step / per_input, -limit, limit)))  # rounded
        readings = [_twist(twin, bench, dwell) for _ in range(READINGS)]
        for _ in range(FURTHER_READINGS):
            if _motion(readings) <= resolution:
                break
            readings = [*readings[1:], _twist(twin, bench, dwell)]
        largest_motion = max(largest_motion, _motion(readings))
        loop.append(readings[-1])
        report(1)
    closed = _with_flanks_parted(*np.array(loop[len(loading) - 1 :]).T)
    couplings = _compliance_of_couplings(scene)
    settled = largest_motion <= resolution
    return LostMotion(*closed, settled, share, couplings, resolution, torque)


def _motion(readings: list[tuple[float, float]]) -> float:
    """Largest change of the twist between successive readings [rad], without the first one."""
    return float(np.abs(np.diff([twist for _, twist in readings[1:]])).max())


def _on_bench(scene: Scene) -> Scene:
    """The gear set at rest between stiff machines; contacts are as stiff as at its torque."""
    changes: dict[str, object] = {
        "input_speed": 0.0,
        "torque_ripple": 0.0,
        **under(scene, "torsional"),
        "mesh.damping": {"law": "viscous", "damping_ratio": MESH_DAMPING},
        "drive.speed_control": {},
        **_heavy_gears(scene),
    }
    for side in ("input", "output"):
        member = getattr(scene.drive, side).member
        stiffness = _stiffness(scene, member)
        inertia = stiffness / (2.0 * math.pi * FREQUENCY) ** 2
        coupling = COUPLING * stiffness
        changes[f"drive.{side}"] = {
            "member": member,
            "inertia": inertia,
            "coupling_stiffness": coupling,
            "coupling_damping": math.sqrt(coupling * inertia),
        }
    return scene.replace(**changes)


def _heavy_gears(scene: Scene) -> dict[str, object]:
    """Inertias with which each gear alone has the frequency `GEARS` on its meshes."""
    radius, planets = Layout(scene).planar_radii, scene.gearset.planets
    sun, ring = (law.single for law in stiffness_laws(scene))
    per_planet = {"sun": sun, "planet": sun + ring, "ring": ring, "carrier": sun + ring}
    inertia = {}
    for kind, stiffness in per_planet.items():
        meshes = 1 if kind == "planet" else planets
        inertia[kind] = meshes * stiffness * radius[kind] ** 2 / (2.0 * math.pi * GEARS) ** 2
    return {
        "gearset.inertia": inertia,
        "gearset.equivalent_mass": None,
        "gearset.planet_mass": CARRIED * inertia["carrier"] / (planets * radius["carrier"] ** 2),
    }


def _compliance_of_couplings(scene: Scene) -> float:
    """Twist of the output per torque on it by both couplings, with the motor held [rad/(N m)]."""
    sides = scene.drive.input, scene.drive.output
    driving, driven = (1.0 / machine.coupling_stiffness for machine in sides)
    return driven + driving * float(Layout(scene).ratios[sides[1].member][0]) ** 2


def _stiffness(scene: Scene, member: str) -> float:
    """Torsional stiffness of the teeth [N m/rad], seen from a member, the others at rest."""
    gears, laws = scene.gearset.geometry, stiffness_laws(scene)
    branch = scene.gearset.planets / sum(1.0 / law.single for law in laws)
    sun, ring = gears.sun.base_radius, gears.ring.base_radius
    return branch * {"sun": sun, "ring": ring, "carrier": sun + ring}[member] ** 2


def _twist(twin: Twin, scene: Scene, duration: float) -> tuple[float, float]:
    """Mean torque on the output [N m] and twist at the end [rad] after another `duration`."""
    window = twin.advance(duration)
    members = scene.drive.input.member, scene.drive.output.member
    angle = dict(zip(window.bodies, np.remainder(window.angle + np.pi, 2.0 * np.pi), strict=True))
    driving, driven = (float(angle[member] - np.pi) for member in members)
    ratio = float(Layout(scene).ratios[members[1]][0])
    return float(window.machine_torque[LOAD_MACHINE]), driven - ratio * driving
