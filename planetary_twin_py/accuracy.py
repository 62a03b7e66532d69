"""Runs whose results are less accurate than their tolerance suggests.

A tolerance limits the error of a step. Three kinds of motion amplify such errors: non-periodic
impacts of flanks, vibration that reverses friction, and friction that has not slid far enough to be
independent of the initial state.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from .dynamics.bodies import rigid_ratios
from .dynamics.creep import CREEPING
from .gearset.geometry import pitch_radius
from .result import Result
from .scene import Scene

SETTLED = 50.0  # presliding displacements of rolling after which the initial state has no effect


class AccuracyWarning(UserWarning):
    """Results of a run are less accurate than its tolerance suggests."""


def accuracy_warnings(scene: Scene, run: Result) -> Iterator[str]:
    """Warnings about results that are less accurate than the tolerance, with a recommendation.

    Args:
        scene: the scene.
        run: its result.

    Returns:
        A sentence per warning.
    """
    if scene.dynamics != "torsional":
        return
    if text := _unsettled(scene, run):
        yield text
    stats = run.stats
    if stats.reversals > 0:
        yield (
            f"vibration stops gears relative to the carrier, or nearly so, in {stats.reversals} "
            "steps: errors grow when friction reverses and may exceed ten times the tolerance; "
            "compare with a run at a tighter tolerance"
        )
    if stats.flank_events > 0 and stats.repeated_steps == 0:
        yield (
            f"flanks engage and separate {stats.flank_events} times, and the motion has not become "
            "periodic: errors may grow with each impact, so single values of the waveform may be "
            "less accurate than the tolerance; compare with a run at a tighter tolerance"
        )


def _unsettled(scene: Scene, run: Result) -> str | None:
    """Warning if creeping gears have hardly moved, else None."""
    gearset, friction = scene.gearset, scene.lubrication
    if not friction.friction:
        return None
    radius = pitch_radius(gearset.teeth.sun, gearset.module) * math.sin(gearset.pressure_angle)
    rolling = radius * _turning(scene)  # of both flanks at the pitch point [m/s]
    rolled, enough = rolling * run.duration, SETTLED * friction.presliding_displacement
    if rolling >= CREEPING or rolled >= enough or rolled == 0.0:
        return None
    return (
        f"the gears creep, and roll by {rolled:.2g} m only: losses and transmission error are "
        f"transient until they have rolled by {enough:.2g} m, {SETTLED:g} times "
        "lubrication.presliding_displacement; simulate "
        f"{run.duration * enough / rolled:.2g} s"
    )


def _turning(scene: Scene) -> float:
    """Magnitude of the set speed of the sun relative to the carrier [rad/s]."""
    point, ratios = scene.operating_point, rigid_ratios(scene)
    inputs = point.input_speed, point.second_input_speed
    sun, carrier = (
        sum(float(ratio) * speed for ratio, speed in zip(ratios[name], inputs, strict=False))
        for name in ("sun", "carrier")
    )
    return abs(sun - carrier)
