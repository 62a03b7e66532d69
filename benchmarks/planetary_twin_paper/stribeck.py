"""Figure 6: the Stribeck curve of one tooth contact."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from matplotlib.figure import Figure

from planetary_twin_py.gearset.geometry import pitch_radius
from planetary_twin_py.plots.style import GREY, panels
from planetary_twin_py.scene import Scene

from .entry import Claim, Entry
from .evidence import Evidence
from .judge import falls, rises
from .pitch_point import contact, static_load

SLIDE_TO_ROLL = 0.2
SPEEDS = np.logspace(-3.0, 2.0, 101)  # mean surface speed [m/s]
BOUNDARY_REGIME = 0.08  # friction coefficient of asperities alone on steel
COMPUTED = {"lubrication.lambda_ratio": "computed"}
MIXED = {"lubrication.boundary": "load_sharing", "lubrication.rolling": "goksem_hargreaves"}


class Curve(NamedTuple):
    """Stribeck curve of a contact."""

    lambda_ratio: np.ndarray
    """(n,)."""
    friction: np.ndarray
    """Friction coefficient including rolling resistance, (n,)."""

    @property
    def lowest(self) -> int:
        """Index of the minimum."""
        return int(self.friction.argmin())


def stribeck_curve(evidence: Evidence) -> Entry:
    """Figure 6."""
    ours, printed = (
        _curve(scene.replace(**COMPUTED)) for scene in (evidence.scene, evidence.printed)
    )
    mixed = _curve(evidence.scene.replace(**COMPUTED, **MIXED))
    highest = max(ours.friction.max(), printed.friction.max())
    other = "; {}, which neither scene has" if _is_stribeck(mixed) else ""
    return Entry(
        number="Figure 6",
        title="Stribeck curve",
        claims=(
            Claim(
                says="three regimes: friction is high without a film and decreases to a minimum as "
                "the film separates the flanks",
                ours=_descent(ours),
                printed=_descent(printed),
                holds=_has_boundary_regime(ours),
                printed_holds=_has_boundary_regime(printed),
                why="with the model of Greenwood and Tripp asperities carry at most a few per cent "
                f"of the load, so friction is below {highest:.3f} and there is no boundary regime"
                + other.format("this regime requires a law of load sharing"),
            ),
            Claim(
                says="beyond the minimum it increases with eta V/W",
                ours=_ascent(ours),
                printed=_ascent(printed),
                holds=_rises_at_the_end(ours),
                printed_holds=_rises_at_the_end(printed),
                why="the plateau of Evans and Johnson decreases steadily with film thickness"
                + other.format("an increase requires the rolling resistance of the film"),
            ),
        ),
        remarks="The curves are for one contact of the sun-planet mesh at a slide-to-roll ratio of "
        f"{SLIDE_TO_ROLL:g} and speeds over the whole range, with sigma = "
        f"{1e6 * evidence.scene.lubrication.composite_roughness:g} um. Both scenes prescribe the "
        "lambda ratio; here it is computed, because it is the variable. The third curve is another "
        "model than the paper's: the scene `paper` with "
        f"{', '.join(f'`{name}: {law}`' for name, law in MIXED.items())}. Its friction coefficient "
        f"is {_descent(mixed)}, and {_ascent(mixed)}. The shaded range is that of the study.",
        picture=_draw(ours, printed, mixed),
        figures={
            "lambda_ratio": ours.lambda_ratio,
            "friction_coefficient": ours.friction,
            "lambda_ratio_mixed": mixed.lambda_ratio,
            "friction_coefficient_mixed": mixed.friction,
        },
    )


def _curve(scene: Scene) -> Curve:
    found = np.array([_point(scene, speed) for speed in SPEEDS])
    return Curve(found[:, 0], found[:, 1])


def _point(scene: Scene, speed: float) -> tuple[float, float]:
    """Lambda ratio and friction coefficient at a mean surface speed [m/s]."""
    gearset = scene.gearset
    sine = math.sin(gearset.transverse.pressure_angle)
    first, second = (
        pitch_radius(z, gearset.transverse.module) * sine
        for z in (gearset.teeth.sun, gearset.teeth.planet)
    )
    fast, slow = (speed * (1.0 + sign * 0.5 * SLIDE_TO_ROLL) for sign in (1.0, -1.0))
    found = contact(scene, (first, second), (fast / first, -slow / second), 1.0)
    taken = found.friction * found.sliding + 2.0 * speed * found.rolling
    return found.lambda_ratio, taken / (static_load(scene) * found.sliding)


def _has_boundary_regime(curve: Curve) -> bool:
    descent = curve.friction[: curve.lowest + 1]
    return bool(descent[0] > BOUNDARY_REGIME) and falls(descent)


def _rises_at_the_end(curve: Curve) -> bool:
    return curve.lowest < len(SPEEDS) - 1 and rises(curve.friction[curve.lowest :])


def _is_stribeck(curve: Curve) -> bool:
    return _has_boundary_regime(curve) and _rises_at_the_end(curve)


def _ascent(curve: Curve) -> str:
    if not _rises_at_the_end(curve):
        return "decreases to the end"
    return f"increases to {curve.friction[-1]:.3f} at {curve.lambda_ratio[-1]:.2g}"


def _descent(curve: Curve) -> str:
    return (
        f"{curve.friction[0]:.3f} at lambda {curve.lambda_ratio[0]:.2g}, "
        f"{curve.friction[curve.lowest]:.3f} at {curve.lambda_ratio[curve.lowest]:.2g}"
    )


def _draw(ours: Curve, printed: Curve, mixed: Curve) -> Figure:
    figure, (axes,) = panels(1, 2.9)
    axes.axvspan(1.0, 2.0, color=GREY, alpha=0.2, lw=0)
    for curve, label in (
        (ours, "scene paper"),
        (printed, "scene paper_printed"),
        (mixed, "with load sharing and rolling resistance"),
    ):
        axes.plot(curve.lambda_ratio, curve.friction, label=label)
    axes.set_xscale("log")
    axes.set_ylim(0, 0.14)
    axes.set_xlabel("lambda ratio")
    axes.set_ylabel("friction coefficient")
    axes.legend(loc="lower left")
    return figure
