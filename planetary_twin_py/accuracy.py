"""Runs whose results are less accurate than their tolerance suggests.

A tolerance limits the error of a step. Three kinds of motion amplify such errors: non-periodic
impacts of flanks, vibration that reverses friction or feeds on it, and friction that has not slid
far enough to be independent of the initial state.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING, NamedTuple

from ._core import CREEPING, Control
from .dynamics.bodies import rigid_ratios
from .planar.held_axes import held_axes_warning
from .scene import OperatingPoint, Scene
from .spatial.face_contact import face_warning

if TYPE_CHECKING:
    from .result import Result

SETTLED = 50.0  # presliding displacements of rolling after which the initial state has no effect


class AccuracyWarning(UserWarning):
    """Results of a run are less accurate than its tolerance suggests."""


class Course(NamedTuple):
    """Counters of a run, or of a part of it, from which its accuracy is estimated."""

    flank_events: int = 0
    """Engagements and separations of flanks."""
    reversals: int = 0
    """Steps in which vibration stops gears, or slows them strongly."""
    repeated_steps: int = 0
    """Steps that were not computed because the motion is periodic."""
    unsettled: float = 0.0
    """Remaining time until friction has forgotten the initial state [s]."""
    both_flanks: int = 0
    """Steps in which both flanks of a mesh touch; the model has a force on one of them only."""
    start_warning: str = ""
    """Why the start of the run is no equilibrium, "" if it is one."""

    @property
    def unrepeated_flank_events(self) -> int:
        """Engagements and separations of flanks, 0 if the motion has become periodic."""
        return 0 if self.repeated_steps else self.flank_events

    def since(self, before: Course) -> Course:
        """Counters of the part of the run after `before`."""
        return Course(
            self.flank_events - before.flank_events,
            self.reversals - before.reversals,
            self.repeated_steps - before.repeated_steps,
            self.unsettled,
            self.both_flanks - before.both_flanks,
            self.start_warning,
        )

    def joined(self, later: Course) -> Course:
        """Counters of this part of a run together with the `later` part."""
        return Course(
            self.flank_events + later.flank_events,
            self.reversals + later.reversals,
            self.repeated_steps + later.repeated_steps,
            later.unsettled,
            self.both_flanks + later.both_flanks,
            self.start_warning or later.start_warning,
        )


def course_so_far(control: Control, unsettled: float) -> Course:
    """Counters of a run from its start.

    Args:
        control: counters of the run, see `integrators.progress`.
        unsettled: remaining time until friction has forgotten the initial state [s].
    """
    return Course(
        int(control.flank_events),
        int(control.reversals),
        int(control.repeated),
        unsettled,
        int(control.both_flanks),
    )


def accuracy_warnings(scene: Scene, run: Result) -> Iterator[str]:
    """Warnings about results that are less accurate than the tolerance, with a recommendation.

    Args:
        scene: the scene.
        run: its result.

    Returns:
        A sentence per warning.
    """
    if line := held_axes_warning(scene):
        yield line
    if line := face_warning(scene, run):
        yield line
    stats, rate = run.stats, settling_rate(scene, scene.operating_point)
    elapsed = max(run.duration, float(run.time[-1]))  # the time of settling counts, too
    missing = unsettled(elapsed * rate, rate)
    yield from course_warnings(
        Course(
            stats.flank_events,
            stats.reversals,
            stats.repeated_steps,
            missing,
            stats.both_flanks,
            run.start_warning,
        )
    )


def course_warnings(course: Course) -> Iterator[str]:
    """Warnings of `accuracy_warnings` for a run or a part of it, from its counters."""
    if course.start_warning:
        yield course.start_warning
    if course.unsettled > 0.0:
        yield (
            "the gears creep, and friction has not forgotten the initial state: losses and "
            f"transmission error are transient until they have rolled by {SETTLED:g} times "
            f"lubrication.presliding_displacement; simulate {course.unsettled:.2g} s more"
        )
    if course.reversals > 0:
        yield (
            f"vibration stops gears relative to the carrier, or slows them strongly, in "
            f"{course.reversals} steps: errors grow when friction reverses, or feeds the vibration "
            "of creeping gears, and may exceed ten times the tolerance; compare with a run at a "
            "tighter tolerance"
        )
    if course.both_flanks > 0:
        yield (
            f"both flanks of a tooth touch in {course.both_flanks} steps, because mesh.runout "
            "or errors close the backlash by more than the load opens it. In this model only one "
            "flank carries: mesh forces and transmission error are wrong there; increase backlash, "
            "or reduce these"
        )
    if course.unrepeated_flank_events > 0:
        yield (
            f"flanks engage and separate {course.unrepeated_flank_events} times, and the motion "
            "has not become periodic: errors may grow with each impact, so single values of the "
            "waveform may be less accurate than the tolerance; compare with a run at a tighter "
            "tolerance"
        )


def settling_rate(scene: Scene, point: OperatingPoint) -> float:
    """Rate at which friction of creeping gears forgets the initial state [1/s].

    Infinite if gears do not creep, 0 if they stand or friction has no memory.

    Args:
        scene: the scene.
        point: its operating point.
    """
    return Settling(scene).rate(point)


class Settling:
    """Rate of `settling_rate` at one operating point after the other.

    Args:
        scene: the scene.
    """

    def __init__(self, scene: Scene) -> None:
        gearset, friction = scene.gearset, scene.lubrication
        self._remembers = not scene.quasi_static and friction.friction
        self._distance = SETTLED * friction.presliding_displacement
        angle = min(mesh.pressure_angle for mesh in gearset.geometry.meshes)
        lever = gearset.geometry.sun.base_radius * math.tan(angle)
        ratios = rigid_ratios(scene)
        self._rolling = [
            lever * float(sun - carrier)
            for sun, carrier in zip(ratios["sun"], ratios["carrier"], strict=True)
        ]

    def rate(self, point: OperatingPoint) -> float:
        """Rate at an operating point [1/s].

        Args:
            point: the operating point.
        """
        if not self._remembers:
            return 0.0
        inputs = point.input_speed, point.second_input_speed
        # Of both flanks at the pitch point [m/s], by the speed of the sun relative to the carrier.
        rolling = abs(sum(per * speed for per, speed in zip(self._rolling, inputs, strict=False)))
        return math.inf if rolling >= CREEPING else rolling / self._distance


def unsettled(share: float, rate: float) -> float:
    """Time until friction has forgotten the initial state [s].

    Args:
        share: rolled share of the distance after which it has.
        rate: present rate of that share [1/s], see `settling_rate`.
    """
    return (1.0 - share) / rate if 0.0 < rate < math.inf and share < 1.0 else 0.0
