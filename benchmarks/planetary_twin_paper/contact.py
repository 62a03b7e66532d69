"""Figures 3 and 5: force against transmission error, and the model of the contact."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from planetary_twin_py._core import damping_time
from planetary_twin_py.model.gearbox import Gearbox
from planetary_twin_py.plots.style import BLUE, GREY, ORANGE, drawing, panels
from planetary_twin_py.scene import Scene
from planetary_twin_py.simulation.simulate import simulate

from .entry import Claim, Entry
from .evidence import Evidence
from .judge import agrees

SAMPLE_RATE = 200_000.0  # [Hz] high enough to differentiate the samples
RUN = 0.02  # [s]
SETTLING = 0.25  # share of the run that is omitted


class Spring(NamedTuple):
    """The sun-planet mesh in the equations of motion of a scene."""

    single: float
    """Stiffness of one pair [N/m]."""
    double: float
    """Stiffness of two pairs [N/m]."""
    half: float
    """Transmission error at which flanks engage [m]."""
    offset: float
    """Transmission error from which the force increases [m]."""
    damping_time: float
    """tau of c = tau k [s]."""

    def force(self, dte: np.ndarray) -> np.ndarray:
        """Static force of one pair [N], (n,).

        Args:
            dte: transmission error [m], (n,).
        """
        push = self.single * np.sign(dte) * (np.abs(dte) - self.offset)
        return np.where(np.abs(dte) > self.half, push, 0.0)

    @property
    def jump(self) -> float:
        """Discontinuity of the force at the engagement of flanks [N]."""
        return self.single * (self.half - self.offset)


def spring(scene: Scene) -> Spring:
    """Stiffness, backlash and damping in the model of a scene.

    Args:
        scene: the scene.
    """
    gearbox = Gearbox(scene)
    train, load = gearbox.train, gearbox.load(scene.operating_point)
    cycle_rate = abs(train.cycles[0]) * scene.operating_point.input_speed / (2.0 * np.pi)
    tau = damping_time(train, 0, cycle_rate)
    single = float(train.stiffness[0])
    double = single * scene.mesh.double_pair_ratio
    return Spring(single, double, float(load.half_backlash), float(load.offset), float(tau))


def regulatory_factor(evidence: Evidence) -> Entry:
    """Figure 3."""
    ours, printed = spring(evidence.scene), spring(evidence.printed)
    backlash = evidence.scene.operating_point.backlash
    jumps = [
        spring(evidence.printed.replace(backlash=b)).jump for b in evidence.study.grid.backlashes
    ]
    least, most = ours.half, printed.half
    return Entry(
        number="Figure 3",
        title="values of the regulatory factor fa",
        claims=(
            Claim(
                says="no torque for a DTE within the backlash, torque beyond it",
                ours=f"no force within +-{1e6 * least:.3g} um, {_slope(ours):.3g} N/um beyond",
                printed=f"no force within +-{1e6 * most:.3g} um, {_slope(printed):.3g} N/um beyond",
                holds=_has_dead_zone(ours),
                printed_holds=_has_dead_zone(printed),
            ),
        ),
        remarks="With the printed factor the force is discontinuous: it jumps by k B when flanks "
        f"engage, {jumps[0]:.0f} to {jumps[-1]:.0f} N for the backlashes of the study, and there "
        "is no equilibrium for smaller loads. The dead zone (Kahraman and Singh 1990) is "
        "continuous: the force is k (DTE - B/2) with the total backlash B. The figure shows "
        f"B = {1e6 * backlash:g} um.",
        picture=_draw_forces(ours, printed, backlash),
        figures={"printed_jumps": jumps},
    )


def _slope(mesh: Spring) -> float:
    return 1e-6 * mesh.single


def _has_dead_zone(mesh: Spring) -> bool:
    within = mesh.force(np.linspace(-mesh.half, mesh.half, 41))
    beyond = mesh.force(mesh.half * np.linspace(1.001, 5.0, 41))
    return bool((within == 0.0).all() and (beyond > 0.0).all())


def _draw_forces(ours: Spring, printed: Spring, backlash: float) -> Figure:
    figure, (axes,) = panels(1, 2.9)
    dte = np.linspace(-2.5, 2.5, 2001) * backlash
    axes.plot(1e6 * dte, ours.force(dte), color=BLUE, label="dead zone (scene paper)")
    axes.plot(
        1e6 * dte, printed.force(dte), color=ORANGE, ls="--", label="fa (scene paper_printed)"
    )
    axes.set_xlabel("dynamic transmission error [um]")
    axes.set_ylabel("force of one pair [N]")
    axes.legend()
    return figure


def contact_model(evidence: Evidence) -> Entry:
    """Figure 5."""
    scenes = (evidence.scene, evidence.printed)
    springs = tuple(spring(scene) for scene in scenes)
    found = [_recovered(scene, mesh) for scene, mesh in zip(scenes, springs, strict=True)]
    pairs = zip(found, springs, strict=True)
    levels = [agrees(k, (mesh.single, mesh.double), 0.01) for k, mesh in pairs]
    texts = [f"{k[0]:.4g} and {k[1]:.4g} N/m" for k in found]
    speed = 30.0 / np.pi * evidence.scene.operating_point.input_speed
    damping = [mesh.damping_time * mesh.single for mesh in springs]
    return Entry(
        number="Figure 5",
        title="gear pair contact model",
        claims=(
            Claim(
                says="a spring and a damper in parallel act on both wheels along the line of "
                "action, (4), (5)",
                ours=f"k = F/(DTE - B/2 + tau DTE') of a run is between {texts[0]}",
                printed=f"F/(DTE + tau DTE') is between {texts[1]}",
                holds=levels[0],
                printed_holds=levels[1],
                kind="number",
                why="the force of a run is not that of a spring and a damper",
            ),
        ),
        remarks=f"The stiffness of one pair is {springs[0].single:g} N/m, that of two pairs "
        f"{springs[0].double:g} N/m. Equations (2) and (3) measure along the pitch arcs, so the "
        f"printed spring is stiffer by 1/cos(phi). At {speed:.0f} rpm the damping coefficient of "
        f"one pair is {damping[0]:.0f} N s/m, in the printed form {damping[1]:.0f} N s/m.",
        picture=_draw_model(springs[0], springs[1]),
        figures={"stiffness_of_a_run": found},
    )


def _recovered(scene: Scene, mesh: Spring) -> tuple[float, float]:
    """10th and 90th percentile of the stiffness in a run [N/m]."""
    result = simulate(scene, RUN, SAMPLE_RATE)
    late = result.time > SETTLING * RUN
    dte, force = result.dte[:, 0], result.mesh_force[:, 0]
    deflection = dte - mesh.offset + mesh.damping_time * np.gradient(dte, 1.0 / SAMPLE_RATE)
    low, high = np.percentile(force[late] / deflection[late], (10.0, 90.0))
    return float(low), float(high)


def _draw_model(ours: Spring, printed: Spring) -> Figure:
    figure, axes = panels(2, 2.4)
    titles = ("scene paper: dead zone", "scene paper_printed: factor fa")
    for place, mesh, title in zip(axes, (ours, printed), titles, strict=True):
        _draw_spring(drawing(place), mesh)
        place.set_title(title, loc="center")
    return figure


def _draw_spring(axes: Axes, mesh: Spring) -> None:
    """Wheel 1, gap, spring and damper in parallel, wheel 2."""
    for end, name in ((0.0, "wheel 1"), (10.0, "wheel 2")):
        axes.plot([end, end], [-1.8, 1.8], color="black", lw=5, solid_capstyle="butt")
        axes.annotate(name, (end, 2.1), ha="center")
    axes.plot([0.2, 1.6], [0, 0], color=BLUE, lw=1.5)
    axes.plot([1.6, 1.6], [-0.7, 0.7], color=BLUE, lw=1.5)
    axes.plot([2.6, 2.6], [-1.1, 1.1], color=BLUE, lw=1.5)
    gap = f"gap {1e6 * mesh.half:.3g} um"
    axes.annotate(gap, (2.1, -1.25), ha="center", va="top", color=BLUE, fontsize=8.5)
    x = np.array([2.6, 4.0, *np.linspace(4.25, 6.75, 6), 7.0, 9.8])
    y = 1.0 + np.array([0, 0, *(0.45 * (-1.0) ** np.arange(6)), 0, 0])
    axes.plot(x, y, color=BLUE, lw=1.5)
    axes.plot([2.6, 5.4], [-1, -1], color=GREY, lw=1.5)
    axes.plot([5.4, 5.4], [-1.4, -0.6], color=GREY, lw=1.5)
    axes.plot([6.2, 5.0, 5.0, 6.2], [-0.5, -0.5, -1.5, -1.5], color=GREY, lw=1.5)
    axes.plot([6.2, 6.2, 6.2, 9.8], [-1.5, -0.5, -1, -1], color=GREY, lw=1.5)
    pairs = f" to {mesh.double:.3g}" if mesh.double > mesh.single else ""
    axes.annotate(
        f"k = {mesh.single:.3g}{pairs} N/m", (5.6, 1.7), ha="center", color=BLUE, fontsize=8.5
    )
    axes.annotate(
        f"c = {1e6 * mesh.damping_time:.1f} us · k", (6.0, -2.1), ha="center", va="top",
        color=GREY, fontsize=8.5,
    )  # fmt: skip
    axes.set_xlim(-1.5, 11.5)
    axes.set_ylim(-3.2, 3.0)
