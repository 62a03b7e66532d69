"""Figure 12: degrees of freedom of the three pairs of bodies."""

from __future__ import annotations

import math

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Circle

from ..gearset.geometry import pitch_radius
from ..scene import Scene
from .eigenproblem import BODIES, printed_modes, twin_modes
from .entry import Claim, Entry
from .evidence import Evidence
from .style import BLUE, GREEN, GREY, ORANGE, PINK, drawing, panels


def degrees_of_freedom(evidence: Evidence) -> Entry:
    """Figure 12."""
    scene = evidence.scene
    torsional = len(printed_modes().frequencies)
    twin = len(twin_modes(scene).frequencies)
    return Entry(
        number="Figure 12",
        title="degrees of freedom of sun-planet, ring-planet and planet-carrier",
        claims=(
            Claim(
                says="of six coordinates of each body only its rotation u = r theta is considered: "
                "six in all",
                ours=f"{twin} and the held carrier",
                printed=f"{torsional} in (37)",
                holds=twin + 1 == len(BODIES),
                printed_holds=torsional == len(BODIES),
                kind="number",
            ),
        ),
        remarks="Drawn from the scene: positions to scale, springs along the lines of action.",
        picture=_draw(scene),
        figures={"torsional": torsional, "twin": twin},
    )


def _draw(scene: Scene) -> Figure:
    figure, axes = panels(3, 3.2)
    sun, planet, ring = (
        1e3 * pitch_radius(z, scene.gearset.module) for z in scene.gearset.tooth_numbers
    )
    angle = scene.gearset.pressure_angle
    arm = np.array([0.0, sun + planet])
    for place, title in zip(axes, ("a) sun-planet", "b) ring-planet", "c) planet-carrier")):
        drawing(place).set_title(title, loc="center")
        _body(place, arm, planet, ORANGE, "planet")
    _body(axes[0], np.zeros(2), sun, BLUE, "sun")
    _spring(axes[0], np.array([0.0, sun]), angle)
    _body(axes[1], np.zeros(2), ring, GREEN, "ring")
    _spring(axes[1], np.array([0.0, ring]), math.pi - angle)
    _body(axes[2], np.zeros(2), sun + planet, GREY, "carrier")
    for direction in (0.0, 0.5 * math.pi):
        _spring(
            axes[2], arm + 3.0 * np.array([math.cos(direction), math.sin(direction)]), direction
        )
    for place in axes:
        place.set_xlim(-31, 31)
        place.set_ylim(-31, 31)
    return figure


def _body(axes: Axes, centre: np.ndarray, radius: float, colour: str, name: str) -> None:
    """A circle with its two translations and its rotation; z and the tilts point out of it."""
    axes.add_patch(Circle(tuple(centre), radius, fill=False, color=colour, lw=1.6))
    for end, label in (((6.0, 0.0), "x"), ((0.0, 6.0), "y")):
        tip = centre + end
        axes.annotate("", tip, centre, arrowprops={"arrowstyle": "->", "color": colour})
        axes.annotate(label, tip + 0.1 * np.array(end), color=colour, fontsize=8.5)
    turn = np.linspace(0.3, 1.3, 20) * math.pi
    arc = centre[:, None] + 0.55 * min(radius, 12.0) * np.array([np.cos(turn), np.sin(turn)])
    axes.plot(arc[0], arc[1], color=colour, lw=1)
    axes.annotate("", arc[:, -1], arc[:, -3], arrowprops={"arrowstyle": "->", "color": colour})
    axes.annotate(name, centre - [0.0, 0.75 * radius + 1.0], ha="center", color=colour)


def _spring(axes: Axes, foot: np.ndarray, angle: float) -> None:
    """A spring through `foot` in a direction [rad] from the x axis."""
    along = np.array([math.cos(angle), math.sin(angle)])
    across = np.array([-along[1], along[0]])
    t = np.array([-4.0, -2.5, *np.linspace(-2.25, 2.25, 7), 2.5, 4.0])
    w = np.array([0.0, 0.0, *(1.1 * (-1.0) ** np.arange(7)), 0.0, 0.0])
    points = foot[:, None] + np.outer(along, t) + np.outer(across, w)
    axes.plot(points[0], points[1], color=PINK, lw=1.3)
