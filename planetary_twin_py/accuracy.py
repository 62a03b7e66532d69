"""Runs whose figures are less accurate than their tolerance says.

A tolerance bounds the error of a step. Three kinds of motion make more of it than a sum of such
errors: flanks that meet and part without ever coming to the same motion again, vibration that stops
gears so that friction reverses, and friction that has not slid far enough to forget how the gears
stood at the start.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING, NamedTuple

from ._records import Record
from .dynamics.bodies import rigid_ratios
from .dynamics.creep import CREEPING
from .gearset.geometry import pitch_radius
from .scene import OperatingPoint, Scene

if TYPE_CHECKING:
    from .result import Result

SETTLED = 50.0  # presliding displacements to roll by until friction has forgotten the start


class AccuracyWarning(UserWarning):
    """Figures of a run are less accurate than its tolerance says."""


class Course(NamedTuple):
    """What the accuracy of a run, or of a part of it, is judged by."""

    flank_events: int = 0
    """Flanks that have met or parted."""
    reversals: int = 0
    """Steps in which vibration stops gears, or nearly so."""
    repeated_steps: int = 0
    """Steps of a motion that repeats itself."""
    unsettled: float = 0.0
    """Time that is missing until friction has forgotten the start [s]."""
    both_flanks: int = 0
    """Steps in which both flanks of a mesh touch, of which one carries in this model."""

    @property
    def unrepeated_flank_events(self) -> int:
        """Flanks that have met or parted, 0 where the motion has come to repeat itself."""
        return 0 if self.repeated_steps else self.flank_events

    def since(self, before: Course) -> Course:
        """What has been counted since `before`, which is of the same run."""
        return Course(
            self.flank_events - before.flank_events,
            self.reversals - before.reversals,
            self.repeated_steps - before.repeated_steps,
            self.unsettled,
            self.both_flanks - before.both_flanks,
        )

    def joined(self, later: Course) -> Course:
        """The course of this part of a run and of the `later` one."""
        return Course(
            self.flank_events + later.flank_events,
            self.reversals + later.reversals,
            self.repeated_steps + later.repeated_steps,
            later.unsettled,
            self.both_flanks + later.both_flanks,
        )


def course_so_far(control: Record, unsettled: float) -> Course:
    """The course of a run from its start.

    Args:
        control: counters of the run, see `integrators.progress`.
        unsettled: time that is missing until friction has forgotten the start [s].
    """
    return Course(
        int(control.flank_events),
        int(control.reversals),
        int(control.repeated),
        unsettled,
        int(control.both_flanks),
    )


def accuracy_warnings(scene: Scene, run: Result) -> Iterator[str]:
    """Sentences that say which figures of a run its tolerance does not bound, and what to do.

    Args:
        scene: that was run.
        run: its result.
    """
    stats, rate = run.stats, settling_rate(scene, scene.operating_point)
    elapsed = max(run.duration, float(run.time[-1]))  # the time of settling counts, too
    missing = unsettled(elapsed * rate, rate)
    yield from course_warnings(
        Course(
            stats.flank_events, stats.reversals, stats.repeated_steps, missing, stats.both_flanks
        )
    )


def course_warnings(course: Course) -> Iterator[str]:
    """The same of the course of a run, or of a part of it."""
    if course.unsettled > 0.0:
        yield (
            "the gears creep, and friction has not forgotten how they stood at the start: until "
            f"they have rolled by {SETTLED:g} times lubrication.presliding_displacement, losses "
            "and transmission error are those of friction that settles; simulate "
            f"{course.unsettled:.2g} s more"
        )
    if course.reversals > 0:
        yield (
            f"vibration stops gears against the carrier, or nearly so, in {course.reversals} "
            "steps: small errors grow where friction reverses, so errors may exceed ten times the "
            "tolerance; compare with a run at a tighter one"
        )
    if course.both_flanks > 0:
        yield (
            f"both flanks of a tooth touch in {course.both_flanks} steps, because mesh.runout "
            "closes the backlash by more than the load opens it, and only one of them carries in "
            "this model: mesh forces and transmission error are wrong there; increase backlash, "
            "or reduce mesh.runout"
        )
    if course.unrepeated_flank_events > 0:
        yield (
            f"flanks meet and part {course.flank_events} times, and the motion has not come to "
            "repeat itself: small errors may grow from hit to hit, so single values of the "
            "waveform may be less accurate than the tolerance; compare with a run at a tighter one"
        )


def settling_rate(scene: Scene, point: OperatingPoint) -> float:
    """Share of the way per second that gears roll until friction has forgotten the start [1/s].

    Infinite where they do not creep, 0 where they stand or friction has no past.

    Args:
        scene: that is run.
        point: where it is run.
    """
    gearset, friction = scene.gearset, scene.lubrication
    if scene.dynamics != "torsional" or not friction.friction:
        return 0.0
    radius = pitch_radius(gearset.teeth.sun, gearset.module) * math.sin(gearset.pressure_angle)
    rolling = radius * _turning(scene, point)  # of both flanks at the pitch point [m/s]
    if rolling >= CREEPING:
        return math.inf
    return rolling / (SETTLED * friction.presliding_displacement)


def unsettled(share: float, rate: float) -> float:
    """Time that is missing until friction has forgotten the start [s].

    Args:
        share: of the way that the gears have rolled.
        rate: of `settling_rate`, at which they roll now.
    """
    return (1.0 - share) / rate if 0.0 < rate < math.inf and share < 1.0 else 0.0


def _turning(scene: Scene, point: OperatingPoint) -> float:
    """Magnitude of the sun's speed against the carrier [rad/s], as it is set."""
    ratios, inputs = rigid_ratios(scene), (point.input_speed, point.second_input_speed)
    sun, carrier = (
        sum(float(ratio) * speed for ratio, speed in zip(ratios[name], inputs, strict=False))
        for name in ("sun", "carrier")
    )
    return abs(sun - carrier)
