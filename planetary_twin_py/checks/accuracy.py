"""Runs whose results are less accurate than their tolerance suggests.

A tolerance limits the error of a step. Three kinds of motion amplify such errors: non-periodic
impacts of flanks, vibration that reverses friction or feeds on it, and friction that has not slid
far enough to be independent of the initial state.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from ..model.layout import Layout
from ..run.counters import SETTLED, Course, Settling, unsettled
from ..scene import Scene
from ..sensors.remarks import reading_remarks
from .face_contact import face_warning
from .fixed_axes import held_axes_warning
from .tooth_entry import entry_warning

if TYPE_CHECKING:
    from ..run.result import Result


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
    if line := entry_warning(scene, run):
        yield line
    for readings in run.sensors.values():
        yield from reading_remarks(readings)
    stats, rate = run.stats, Settling(Layout(scene)).rate(scene.operating_point)
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
            "the gears creep, and friction still depends on the initial state: losses and "
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
