"""Figures 7 and 8: viscous friction against DTE, boundary friction against the lambda ratio."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.figure import Figure
from planetary_twin_core_parts import printed_area_function, printed_load_function
from scipy.optimize import brentq

from planetary_twin_py.plots.style import CYCLE, panels

from .entry import Claim, Entry
from .evidence import Evidence
from .judge import falls, percent, rises
from .pitch_point import KINDS, RING, SUN, at_pitch_point
from .study import Study

LEAST_EFFECT = 0.5  # relative change of friction per relative change of DTE to be "notable"


def viscous_friction(evidence: Evidence) -> Entry:
    """Figure 7."""
    ours, printed = _against_load(evidence.study), _against_load(evidence.printed_study)
    effects = [[_effect(dte, friction) for dte, friction in found] for found in (ours, printed)]
    study = evidence.study
    dte, friction = study.over_grid(lambda o: o.sun.dte), study.over_grid(lambda o: o.sun.viscous)
    rise = 1e6 * float(np.ptp(dte, axis=0).max())
    torques = study.grid.torques
    return Entry(
        number="Figure 7",
        title="viscous friction against DTE at 1000 rpm",
        claims=(
            Claim(
                says="viscous friction increases with DTE in both meshes",
                ours=_ranges(ours),
                printed=_ranges(printed),
                holds=_increases(ours),
                printed_holds=_increases(printed),
                why="friction does not increase with DTE",
            ),
            Claim(
                says="a small change of DTE affects it notably",
                ours=f"1 % of DTE changes it by {effects[0][SUN]:.2f} % (sun-planet), "
                f"{effects[0][RING]:.2f} % (planet-ring)",
                printed=f"{effects[1][SUN]:.2f} %, {effects[1][RING]:.2f} %",
                holds=min(effects[0]) > LEAST_EFFECT,
                printed_holds=min(effects[1]) > LEAST_EFFECT,
                why="friction depends little on DTE",
            ),
        ),
        remarks=f"The values are means of runs at {torques[0]:g} to {torques[-1]:g} N m: DTE "
        "increases with the load, as the paper assumes. Backlash does not have this effect: from "
        f"the smallest to the largest B of the study, the mean DTE increases by {rise:.3f} um and "
        f"friction changes by {abs(percent(friction, 0)):.3f} %.",
        picture=_draw_viscous(ours, printed),
        figures={"dte_and_friction": [[list(a), list(b)] for a, b in ours]},
    )


Curves = Sequence[tuple[np.ndarray, np.ndarray]]  # DTE [m] and friction [N] of both kinds of mesh


def _against_load(study: Study) -> Curves:
    return [
        (study.over_torques(lambda o: o.sun.dte), study.over_torques(lambda o: o.sun.viscous)),
        (study.over_torques(lambda o: o.ring.dte), study.over_torques(lambda o: o.ring.viscous)),
    ]


def _effect(dte: np.ndarray, friction: np.ndarray) -> float:
    """Relative change of friction per relative change of DTE."""
    return float(np.polyfit(np.log(dte), np.log(friction), 1)[0])


def _increases(curves: Curves) -> bool:
    return all(rises(dte) and rises(friction) for dte, friction in curves)


def _ranges(curves: Curves) -> str:
    return "; ".join(
        f"{1e6 * dte[0]:.2f} to {1e6 * dte[-1]:.2f} um: {force[0]:.1f} to {force[-1]:.1f} N"
        for dte, force in curves
    )


def _draw_viscous(ours: Curves, printed: Curves) -> Figure:
    figure, axes = panels(2, 2.8)
    for kind, place in enumerate(axes):
        for curves, label in ((ours, "scene paper"), (printed, "scene paper_printed")):
            dte, friction = curves[kind]
            place.plot(1e6 * dte, friction, "o-", label=label)
        place.set_title(f"{'ab'[kind]}) {KINDS[kind]}")
        place.set_xlabel("mean DTE [um]")
    axes[0].set_ylabel("viscous friction [N]")
    axes[0].legend()
    return figure


_RATIOS = np.linspace(1.0, 2.5, 301)  # lambda ratios


def boundary_friction(evidence: Evidence) -> Entry:
    """Figure 8."""
    ours, printed = (_over_grid(study) for study in (evidence.study, evidence.printed_study))
    at_pitch = {
        scene.name: [
            at_pitch_point(scene.replace(lambda_ratio=ratio), SUN).boundary
            for ratio in evidence.study.grid.lambda_ratios
        ]
        for scene in (evidence.scene, evidence.printed)
    }
    texts = {name: ", ".join(f"{force:.3f}" for force in f) for name, f in at_pitch.items()}
    negative = brentq(printed_area_function, 1.5, 2.5)
    rising = float(_RATIOS[np.argmin([printed_load_function(x) for x in _RATIOS])])
    share = ours[SUN].max() / evidence.study.over_grid(lambda o: o.sun.viscous).max()
    return Entry(
        number="Figure 8",
        title="boundary friction against the lambda ratio",
        claims=(
            Claim(
                says="boundary friction decreases with lambda",
                ours=_fall(ours),
                printed=_fall(printed),
                holds=all(falls(force, 1) for force in ours),
                printed_holds=all(falls(force, 1) for force in printed),
                why="friction does not decrease with lambda",
            ),
        ),
        remarks="Boundary friction of one pair at the pitch point of the sun-planet mesh: "
        f"{texts['paper']} N, as printed {texts['paper_printed']} N. The printed F_2 is negative "
        f"above lambda {negative:.2f}, and the printed F_5/2 increases above {rising:.2f}; both "
        "are in the range of the study. Asperities carry little load, so boundary friction is at "
        f"most {share:.1%} of viscous friction.",
        picture=_draw_boundary(ours, printed, evidence.study.grid.lambda_ratios),
        figures={"at_pitch_point": at_pitch},
    )


def _over_grid(study: Study) -> list[np.ndarray]:
    return [
        study.over_grid(lambda o: o.sun.boundary),
        study.over_grid(lambda o: o.ring.boundary),
    ]


def _fall(friction: Sequence[np.ndarray]) -> str:
    ends = [force.mean(axis=(0, 2))[[0, -1]] for force in friction]
    return ", ".join(
        f"{kind} {first:.2f} to {last:.3f} N"
        for kind, (first, last) in zip(KINDS, ends, strict=True)
    )


_TICKS = (0.1, 0.2, 0.5, 1.0, 2.0)  # [N]


def _draw_boundary(
    ours: Sequence[np.ndarray], printed: Sequence[np.ndarray], ratios: Sequence[float]
) -> Figure:
    figure, axes = panels(2, 2.8)
    for kind, place in enumerate(axes):
        for found, label, colour in (
            (ours, "scene paper", CYCLE[0]),
            (printed, "scene paper_printed", CYCLE[1]),
        ):
            force = found[kind]
            place.plot(ratios, force.mean(axis=(0, 2)), "o-", color=colour, label=label)
        place.set_title(f"{'ab'[kind]}) {KINDS[kind]}")
        place.set_xlabel("lambda ratio")
        place.set_xticks(ratios)
        place.set_yscale("log")
        place.set_yticks(_TICKS, [f"{tick:g}" for tick in _TICKS])
        place.minorticks_off()
    axes[0].set_ylabel("boundary friction [N]")
    axes[0].legend()
    return figure
