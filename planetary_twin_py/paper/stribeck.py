"""Figure 6: the Stribeck curve of one tooth contact."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from matplotlib.figure import Figure

from ..gearset.geometry import pitch_radius
from ..plots.style import GREY, panels
from ..scene import Scene
from .entry import Claim, Entry
from .evidence import Evidence
from .judge import falls, rises
from .pitch_point import contact, static_load

SLIDE_TO_ROLL = 0.2
SPEEDS = np.logspace(-3.0, 2.0, 101)  # mean surface speed [m/s]
BOUNDARY_REGIME = 0.08  # friction coefficient that asperities alone reach on steel
MIXED = {
    "lubrication.boundary": "load_sharing",
    "lubrication.rolling": "goksem_hargreaves",
    "lubrication.lambda_ratio": "computed",
}


class Curve(NamedTuple):
    """Friction coefficient, rolling resistance included, against the lambda ratio."""

    lambda_ratio: np.ndarray
    friction: np.ndarray

    @property
    def lowest(self) -> int:
        """Place of the minimum."""
        return int(self.friction.argmin())


def stribeck_curve(evidence: Evidence) -> Entry:
    """Figure 6."""
    ours = _curve(evidence.scene.replace(**MIXED))
    printed = _curve(evidence.printed.replace(**{"lubrication.lambda_ratio": "computed"}))
    bottom = ours.lowest
    return Entry(
        number="Figure 6",
        title="Stribeck curve",
        claims=(
            Claim(
                says="three regimes: friction is high without a film and falls to a minimum as "
                "the film separates the flanks",
                ours=_text(ours),
                printed=_text(printed),
                holds=_has_boundary_regime(ours),
                printed_holds=_has_boundary_regime(printed),
                why="friction has no boundary regime",
            ),
            Claim(
                says="beyond the minimum it rises with eta V/W",
                ours=f"from {ours.friction[bottom]:.3f} at lambda {ours.lambda_ratio[bottom]:.2g} "
                f"to {ours.friction[-1]:.3f} at {ours.lambda_ratio[-1]:.2g}",
                printed="falls to the end" if printed.lowest == len(SPEEDS) - 1 else "rises",
                holds=bottom < len(SPEEDS) - 1 and rises(ours.friction[bottom:]),
                printed_holds=printed.lowest < len(SPEEDS) - 1
                and rises(printed.friction[printed.lowest :]),
                why="friction does not rise beyond the minimum",
            ),
        ),
        remarks="One contact of the sun-planet mesh at a slide-to-roll ratio of "
        f"{SLIDE_TO_ROLL:g} whose speed varies over the whole range, sigma "
        f"{1e6 * evidence.scene.lubrication.composite_roughness:g} um. The boundary regime needs a "
        "law of load sharing (`lubrication.boundary: load_sharing`), the rise the film's rolling "
        "resistance (`lubrication.rolling: goksem_hargreaves`). The paper's own equations have "
        f"neither: Greenwood and Tripp's asperities carry a few per cent of the load at most, so "
        f"friction stays below {printed.friction.max():.3f}, and Evans and Johnson's plateau only "
        "falls with the film. The shaded range is that of the paper's study.",
        picture=_draw(ours, printed),
        figures={"lambda_ratio": ours.lambda_ratio, "friction_coefficient": ours.friction},
    )


def _curve(scene: Scene) -> Curve:
    found = np.array([_point(scene, speed) for speed in SPEEDS])
    return Curve(found[:, 0], found[:, 1])


def _point(scene: Scene, speed: float) -> tuple[float, float]:
    """Lambda ratio and friction coefficient at a mean surface speed [m/s]."""
    gearset = scene.gearset
    sine = math.sin(gearset.pressure_angle)
    first, second = (
        pitch_radius(z, gearset.module) * sine for z in (gearset.teeth.sun, gearset.teeth.planet)
    )
    fast, slow = (speed * (1.0 + sign * 0.5 * SLIDE_TO_ROLL) for sign in (1.0, -1.0))
    found = contact(scene, (first, second), (fast / first, -slow / second), 1.0)
    taken = found.friction * found.sliding + 2.0 * speed * found.rolling
    return found.lambda_ratio, taken / (static_load(scene) * found.sliding)


def _has_boundary_regime(curve: Curve) -> bool:
    descent = curve.friction[: curve.lowest + 1]
    return bool(descent[0] > BOUNDARY_REGIME) and falls(descent)


def _text(curve: Curve) -> str:
    return (
        f"{curve.friction[0]:.3f} at lambda {curve.lambda_ratio[0]:.2g}, "
        f"{curve.friction[curve.lowest]:.3f} at {curve.lambda_ratio[curve.lowest]:.2g}"
    )


def _draw(ours: Curve, printed: Curve) -> Figure:
    figure, (axes,) = panels(1, 2.9)
    axes.axvspan(1.0, 2.0, color=GREY, alpha=0.2, lw=0)
    for curve, label in (
        (ours, "load sharing, rolling resistance"),
        (printed, "printed equations"),
    ):
        axes.plot(curve.lambda_ratio, curve.friction, label=label)
    axes.set_xscale("log")
    axes.set_ylim(0, 0.14)
    axes.set_xlabel("lambda ratio")
    axes.set_ylabel("friction coefficient")
    axes.legend(loc="upper right")
    return figure
