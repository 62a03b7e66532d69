"""Figure 12: degrees of freedom of the three pairs of bodies."""

from __future__ import annotations

import math

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Circle

from planetary_twin_py.gearset.geometry import pitch_radius
from planetary_twin_py.modal.natural import natural_modes, spring_model
from planetary_twin_py.modal.printed import EQUATION_37, printed_model
from planetary_twin_py.plots.style import BLUE, GREEN, GREY, ORANGE, PINK, drawing, panels
from planetary_twin_py.scene import Scene
from planetary_twin_py.scene.supports import Support, Supports

from .entry import Claim, Entry
from .evidence import Evidence
from .tables import MASSES

BEARING = 2e8  # [N/m] arbitrary: the number of coordinates does not depend on it


def degrees_of_freedom(evidence: Evidence) -> Entry:
    """Figure 12."""
    scene = evidence.scene
    supports = {
        name: Support(mass=mass, bearing=BEARING, axial=BEARING, tilting=BEARING)
        for name, mass in MASSES.items()
    }
    supported = scene.model_copy(update={"supports": Supports(**supports)})
    spatial = spring_model(supported, "spatial").coordinates
    torsional = natural_modes(scene).coordinates
    printed = printed_model(EQUATION_37).coordinates
    pair = [name for name in spatial if name.split(".")[0] in ("sun", "planet_1")]
    return Entry(
        number="Figure 12",
        title="degrees of freedom of sun-planet, ring-planet and planet-carrier",
        claims=(
            Claim(
                says="each body has three translations and three rotations, a pair of bodies "
                "twelve coordinates",
                ours=f"{len(pair)} per pair, {len(spatial)} in total and the held rotation of the "
                f"{scene.gearset.held}",
                holds=len(pair) == 12 and len(spatial) + 1 == 36,
                kind="number",
            ),
            Claim(
                says="only the six rotations u = r theta are used",
                ours=f"{len(torsional)} and the held one",
                printed=f"{len(printed)}",
                holds=len(torsional) + 1 == 6,
                printed_holds=len(printed) == 6,
                kind="number",
            ),
        ),
        remarks="The figure is drawn from the scene, with positions to scale. Springs represent "
        "the meshes along their lines of action and the bearing of the planet. Motion along z and "
        'tilting are not drawn. `natural_modes(scene, "spatial")` solves the spatial model for '
        "scenes with bearings (`supports`).",
        picture=_draw(scene),
        figures={"spatial": spatial, "torsional": torsional, "printed": printed},
    )


def _draw(scene: Scene) -> Figure:
    figure, axes = panels(3, 3.2)
    sun, planet, ring = (
        1e3 * pitch_radius(z, scene.gearset.transverse.module) for z in scene.gearset.tooth_numbers
    )
    angle, arm = scene.gearset.transverse.pressure_angle, sun + planet
    titles = ("a) sun-planet", "b) ring-planet", "c) planet-carrier")
    for place, title in zip(axes, titles, strict=True):
        drawing(place).set_title(title, loc="center")
        _body(place, arm, planet, ORANGE, "planet")
    _body(axes[0], 0.0, sun, BLUE, "sun")
    _body(axes[1], 0.0, ring, GREEN, "ring")
    _body(axes[2], 0.0, arm, GREY, "carrier")
    _spring(axes[0], (0.0, sun), angle)
    _spring(axes[1], (0.0, ring), math.pi - angle)
    for direction in (-0.25 * math.pi, -0.75 * math.pi):
        foot = (4.0 * math.cos(direction), arm + 4.0 * math.sin(direction))
        _spring(axes[2], foot, direction)
    for place in axes:
        place.set_xlim(-34, 31)
        place.set_ylim(-30, 31)
    return figure


def _body(axes: Axes, y: float, radius: float, colour: str, name: str) -> None:
    """A circle with two translations at its centre and the rotation on its left [mm]."""
    axes.add_patch(Circle((0.0, y), radius, fill=False, color=colour, lw=1.6))
    arrow = {"arrowstyle": "->", "color": colour, "shrinkA": 0.0, "shrinkB": 0.0}
    reach = min(0.7 * radius, 9.0)
    for text, tip in (("x", (reach, y)), ("y", (0.0, y + reach))):
        axes.annotate("", tip, (0.0, y), arrowprops=arrow)
        beside = (tip[0] - 0.5, tip[1] + 0.6) if text == "x" else (0.7, tip[1] - 2.5)
        axes.annotate(text, beside, color=colour, fontsize=8)
    turn = np.linspace(0.75, 1.25, 30) * math.pi
    arc = 1.12 * radius * np.array([np.cos(turn), np.sin(turn)])
    axes.plot(arc[0], y + arc[1], color=colour, lw=1)
    axes.annotate("", (arc[0, -1], y + arc[1, -1]), (arc[0, -4], y + arc[1, -4]), arrowprops=arrow)
    axes.annotate("u", (-1.12 * radius - 0.6, y), color=colour, ha="right", fontsize=8)
    inside = radius > 15.0
    place = (0.0, y - 0.8 * radius) if inside else (radius + 1.0, y - 0.2 * radius)
    axes.annotate(name, place, ha="center" if inside else "left", color=colour, fontsize=8.5)


def _spring(axes: Axes, foot: tuple[float, float], angle: float) -> None:
    """A spring through `foot` in a direction [rad] from the x axis."""
    t = np.array([-4.0, -2.5, *np.linspace(-2.25, 2.25, 7), 2.5, 4.0])
    w = np.array([0.0, 0.0, *(1.1 * (-1.0) ** np.arange(7)), 0.0, 0.0])
    c, s = math.cos(angle), math.sin(angle)
    axes.plot(foot[0] + c * t - s * w, foot[1] + s * t + c * w, color=PINK, lw=1.3)
