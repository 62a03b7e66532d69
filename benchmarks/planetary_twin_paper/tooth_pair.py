"""Figure 2: a tooth pair with backlash, drawn with true involutes."""

from __future__ import annotations

import math

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from planetary_twin_py.gearset.geometry import base_pitch
from planetary_twin_py.gearset.involute import SpurGear
from planetary_twin_py.gearset.mount import Mate, mount_angle
from planetary_twin_py.plots.style import BLUE, GREY, ORANGE, drawing, panels
from planetary_twin_py.scene import Scene

from .entry import Claim, Entry
from .evidence import Evidence
from .judge import agrees

ENLARGED = 1000.0  # the drawn backlash over the true one
POINTS = 60  # on each flank
DRIVE, COAST = 1.0, -1.0


def tooth_pair(evidence: Evidence) -> Entry:
    """Figure 2."""
    scene = evidence.scene
    backlash = scene.operating_point.backlash
    sun, planet = _outlines(scene, ENLARGED * backlash)
    drive, coast = (_gap(sun, planet, scene, side) / ENLARGED for side in (DRIVE, COAST))
    return Entry(
        number="Figure 2",
        title="gear-pair backlash",
        claims=(
            Claim(
                says="while one flank of a tooth is in contact, there is a gap B at the other",
                ours=f"gaps between the drawn flanks, divided by {ENLARGED:g}: {1e6 * drive:.3f} "
                f"and {1e6 * coast:.3f} um, with B = {1e6 * backlash:g} um",
                holds=abs(drive) < 1e-2 * backlash and agrees(coast, backlash, 1e-2),
                kind="number",
            ),
        ),
        remarks=f"The figure shows true involutes of sun and planet with a gap enlarged "
        f"{ENLARGED:g} times. Gears of module 0.8 mm are manufactured with a backlash of 30 to 60 "
        "um, about a hundred times the values of the paper.",
        picture=_draw(sun, planet, scene),
        figures={"gap_drive": drive, "gap_coast": coast},
    )


def _outlines(scene: Scene, backlash: float) -> tuple[np.ndarray, np.ndarray]:
    """Outlines of sun and planet [m], (n, 2), with the pitch point at the origin.

    The teeth of the planet, which is on the right, are thinner by the backlash on the line of
    action. The planet is rotated until its driven flanks contact those of the sun.
    """
    gearset = scene.gearset
    teeth, data = (
        gearset.tooth_numbers,
        (gearset.transverse.module, gearset.transverse.pressure_angle, gearset.addendum),
    )
    first, second = SpurGear(teeth.sun, *data), SpurGear(teeth.planet, *data)
    sun_angle = -0.5 * math.pi / teeth.sun  # its leading flank at the pitch point
    angle = mount_angle(teeth.planet, math.pi, Mate(teeth.sun, sun_angle, 0.0))
    thinning = backlash / second.base_radius
    sun = _cartesian(first.outline(POINTS), sun_angle) - np.array([first.pitch_radius, 0.0])
    thinned = _thinned(second, 0.5 * thinning)
    planet = _cartesian(thinned, angle + 0.5 * thinning) + np.array([second.pitch_radius, 0.0])
    return sun, planet


def _thinned(gear: SpurGear, angle: float) -> np.ndarray:
    """Outline of a gear whose flanks are offset into the tooth by `angle` [rad]."""
    tooth = gear.tooth(POINTS)
    pitch, own = 2.0 * math.pi / gear.teeth, len(tooth) - 3  # the last three are the root's
    tooth[:own, 1] -= angle * np.sign(tooth[:own, 1])
    teeth = np.arange(gear.teeth)
    outline = np.tile(tooth, (len(teeth), 1))
    outline[:, 1] += np.repeat(pitch * teeth, len(tooth))
    return outline


def _cartesian(polar: np.ndarray, angle: float) -> np.ndarray:
    radius, direction = polar[:, 0], polar[:, 1] + angle
    return np.column_stack((radius * np.cos(direction), radius * np.sin(direction)))


def _line(scene: Scene, side: float) -> np.ndarray:
    """Direction of the line of action on which the sun pushes with one side of its teeth."""
    angle = scene.gearset.transverse.pressure_angle
    return np.array([math.sin(angle), side * math.cos(angle)])


def _gap(sun: np.ndarray, planet: np.ndarray, scene: Scene, side: float) -> float:
    """Gap between the flanks nearest to the pitch point on a line of action [m]."""
    along = _line(scene, side)
    reach = 2.0 * scene.gearset.transverse.module  # more than half a base pitch
    gaps = [
        b - a
        for a in _crossings(sun, along, 1.0)
        for b in _crossings(planet, along, -1.0)
        if abs(a) < reach and abs(b - a) < 0.5 * reach
    ]
    return min(gaps, key=abs)


def _crossings(outline: np.ndarray, along: np.ndarray, sense: float) -> list[float]:
    """Distances from the pitch point at which a line leaves (sense 1) or enters (-1) a gear [m]."""
    position = outline @ along
    height = outline @ np.array([-along[1], along[0]])
    crosses = height[:-1] * height[1:] < 0.0
    cut = np.nonzero(crosses & (sense * np.diff(height) > 0.0))[0]
    share = height[cut] / (height[cut] - height[cut + 1])
    return list(position[cut] + share * (position[cut + 1] - position[cut]))


def _draw(sun: np.ndarray, planet: np.ndarray, scene: Scene) -> Figure:
    figure, (wide, near) = panels(2, 3.4)
    for axes, reach in ((wide, 6.0), (near, 1.6)):
        _teeth(drawing(axes), sun, planet, scene, reach)
    wide.set_title("sun (left) and planet", loc="center")
    near.set_title(f"at the pitch point, gap enlarged {ENLARGED:g} times", loc="center")
    away = 500.0 * base_pitch(
        scene.gearset.transverse.module, scene.gearset.transverse.pressure_angle
    )  # half of one
    for text, point, place in (
        ("contact", (0.0, 0.0), (-1.55, 0.3)),
        ("gap B", tuple(away * _line(scene, COAST)), (-1.55, -1.0)),
    ):
        arrow = {"arrowstyle": "->", "color": "black", "lw": 0.8}
        near.annotate(text, point, place, arrowprops=arrow)
    return figure


def _teeth(axes: Axes, sun: np.ndarray, planet: np.ndarray, scene: Scene, reach: float) -> None:
    """Both outlines around the pitch point and the two lines of action, in mm."""
    for outline, colour in ((sun, BLUE), (planet, ORANGE)):
        closed = 1e3 * np.vstack((outline, outline[:1]))
        axes.fill(closed[:, 0], closed[:, 1], color=colour, alpha=0.18, lw=0)
        axes.plot(closed[:, 0], closed[:, 1], color=colour, lw=1.3)
    for side, style in ((DRIVE, "-"), (COAST, "--")):
        ends = np.outer([-reach, reach], _line(scene, side))
        axes.plot(ends[:, 0], ends[:, 1], color=GREY, lw=0.8, ls=style)
    axes.set_xlim(-reach, reach)
    axes.set_ylim(-reach, reach)
