"""Runs whose figures are less accurate than their tolerance says.

A tolerance bounds the error of a step. Three kinds of motion make more of it than a sum of such
errors: flanks that meet and part without ever coming to the same motion again, vibration that stops
gears so that friction reverses, and friction that has not slid far enough to forget how the gears
stood at the start.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from .dynamics.bodies import rigid_ratios
from .dynamics.creep import CREEPING
from .gearset.geometry import pitch_radius
from .result import Result
from .scene import Scene

SETTLED = 50.0  # presliding displacements to roll by until friction has forgotten the start


class AccuracyWarning(UserWarning):
    """Figures of a run are less accurate than its tolerance says."""


def accuracy_warnings(scene: Scene, run: Result) -> Iterator[str]:
    """Sentences that say which figures of a run its tolerance does not bound, and what to do.

    Args:
        scene: that was run.
        run: its result.
    """
    if scene.dynamics != "torsional":
        return
    if text := _unsettled(scene, run):
        yield text
    stats = run.stats
    if stats.reversals > 0:
        yield (
            f"vibration stops gears against the carrier, or nearly so, in {stats.reversals} steps: "
            "small errors grow where friction reverses, so errors may exceed ten times the "
            "tolerance; compare with a run at a tighter one"
        )
    if stats.flank_events > 0 and stats.repeated_steps == 0:
        yield (
            f"flanks meet and part {stats.flank_events} times, and the motion has not come to "
            "repeat itself: small errors may grow from hit to hit, so single values of the "
            "waveform may be less accurate than the tolerance; compare with a run at a tighter one"
        )


def _unsettled(scene: Scene, run: Result) -> str | None:
    """Say so where creeping gears have hardly moved."""
    gearset, friction = scene.gearset, scene.lubrication
    if not friction.friction:
        return None
    radius = pitch_radius(gearset.teeth.sun, gearset.module) * math.sin(gearset.pressure_angle)
    rolling = radius * _turning(scene)  # of both flanks at the pitch point [m/s]
    rolled, enough = rolling * run.duration, SETTLED * friction.presliding_displacement
    if rolling >= CREEPING or rolled >= enough or rolled == 0.0:
        return None
    return (
        f"the gears creep and roll by {rolled:.2g} m only: until they have rolled by "
        f"{enough:.2g} m, {SETTLED:g} times lubrication.presliding_displacement, losses and "
        "transmission error are those of friction that settles; simulate "
        f"{run.duration * enough / rolled:.2g} s"
    )


def _turning(scene: Scene) -> float:
    """Magnitude of the sun's speed against the carrier [rad/s], as it is set."""
    point, ratios = scene.operating_point, rigid_ratios(scene)
    inputs = point.input_speed, point.second_input_speed
    sun, carrier = (
        sum(float(ratio) * speed for ratio, speed in zip(ratios[name], inputs, strict=False))
        for name in ("sun", "carrier")
    )
    return abs(sun - carrier)
