"""Figure 9: forces and torque on a planet against speed and lambda ratio."""

from __future__ import annotations

import math

import numpy as np
from matplotlib.figure import Figure

from planetary_twin_py.gearset.geometry import pitch_radius
from planetary_twin_py.plots.style import CYCLE, panels

from .entry import Claim, Entry
from .evidence import Evidence
from .judge import percent, rises
from .study import Study


def planet_forces(evidence: Evidence) -> Entry:
    """Figure 9."""
    ours, printed = (_forces(study) for study in (evidence.study, evidence.printed_study))
    gearset = evidence.scene.gearset
    sine, cosine = (
        math.sin(gearset.transverse.pressure_angle),
        math.cos(gearset.transverse.pressure_angle),
    )
    arm = pitch_radius(gearset.teeth.planet, gearset.transverse.module) * cosine
    parts = {"tangential": cosine, "radial": sine, "total": 1.0, "torque": arm}
    mean, largest = ours["mean"].mean(), ours["largest"].mean(axis=(0, 1))
    speeds = evidence.study.grid.speeds
    spread = 100.0 * float(np.ptp(ours["mean"])) / mean
    growth, printed_growth = (percent(forces["largest"], 2) for forces in (ours, printed))
    why = (
        "the input torque is given, so the mean forces follow from statics: in the whole study "
        f"they differ by {spread:.2f} %; only the largest force of a cycle changes with speed, by "
        f"{growth:+.1f} %, and as printed by {printed_growth:+.1f} %"
    )
    peaks = ", ".join(
        f"{force:.0f} N at {speed:g} rpm" for force, speed in zip(largest, speeds, strict=True)
    )
    return Entry(
        number="Figure 9",
        title="forces and torque on a planet against speed and lambda",
        claims=(
            _claim("speed", ours, printed, 2, why),
            _claim("lambda", ours, printed, 1, why),
        ),
        remarks=f"The mean force of the sun on a planet is {mean:.0f} N: {mean * cosine:.0f} N "
        f"tangential, {mean * sine:.0f} N radial, and a torque of {mean * arm:.2f} N m about the "
        "pin. All four are the mesh force times a constant, so their curves have the same shape. "
        "The largest force of a cycle (dashed) changes with speed, as the mesh frequency changes "
        f"relative to the natural frequencies: {peaks}.",
        picture=_draw(evidence.study, ours, parts),
        figures={"mean_force": ours["mean"].mean(axis=0), "largest_force": largest},
    )


def _forces(study: Study) -> dict[str, np.ndarray]:
    return {
        "mean": study.over_grid(lambda o: o.sun.force),
        "largest": study.over_grid(lambda o: o.sun.largest_force),
    }


def _claim(
    name: str, ours: dict[str, np.ndarray], printed: dict[str, np.ndarray], axis: int, why: str
) -> Claim:
    return Claim(
        says=f"the forces increase with {name}",
        ours=_changes(ours, axis),
        printed=_changes(printed, axis),
        holds=all(rises(force, axis) for force in ours.values()),
        printed_holds=all(rises(force, axis) for force in printed.values()),
        why=why,
    )


def _changes(forces: dict[str, np.ndarray], axis: int) -> str:
    return ", ".join(f"{name} {percent(force, axis):+.2f} %" for name, force in forces.items())


def _draw(study: Study, forces: dict[str, np.ndarray], parts: dict[str, float]) -> Figure:
    """Components of the force: means solid, largest values dashed; torque in its own panel."""
    figure, (speed, ratio, torque) = panels(3, 3.0)
    speeds, ratios = study.grid.speeds, study.grid.lambda_ratios
    mean, largest = forces["mean"], forces["largest"]
    for colour, (name, factor) in zip(CYCLE, parts.items(), strict=False):
        axes = torque if name == "torque" else speed
        axes.plot(speeds, factor * mean[0, 0], "o-", color=colour, label=name)
        axes.plot(speeds, factor * largest[0, 0], "o--", color=colour, lw=1)
        if name != "torque":
            ratio.plot(ratios, factor * mean[0, :, 0], "o-", color=colour)
            ratio.plot(ratios, factor * largest[0, :, 0], "o--", color=colour, lw=1)
    for axes in (speed, torque):
        axes.set_xlabel("input speed [rpm]")
        axes.set_xticks(speeds)
    ratio.set_xlabel("lambda ratio")
    speed.set_ylabel("force of the sun [N]")
    torque.set_ylabel("torque [N m]")
    for axes, title in zip((speed, ratio, torque), ("force", "force", "torque"), strict=True):
        axes.set_ylim(0, None)
        axes.set_title(title)
    figure.legend(loc="outside lower center", ncols=4)
    return figure
