"""Figure 1 and Table 1: bodies, joints and stick diagram."""

from __future__ import annotations

import math

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Circle

from planetary_twin_py.gearset.geometry import pitch_radius
from planetary_twin_py.gearset.phasing import check_assembly
from planetary_twin_py.model.gearbox import Gearbox
from planetary_twin_py.model.layout import Layout
from planetary_twin_py.plots.style import BLUE, GREEN, GREY, ORANGE, PINK, drawing, panels
from planetary_twin_py.scene import Scene, load_scene

from .entry import Claim, Entry
from .evidence import Evidence

PRINTED_ANGLES = (90.0, -30.0, 210.0)  # [deg] section 9


def bodies(evidence: Evidence) -> Entry:
    """Table 1."""
    scene = evidence.scene
    free, held = _free_and_held(scene)
    stated = {"sun", "planet_1", "planet_2", "planet_3", "ring"}
    return Entry(
        number="Table 1",
        title="bodies and joints",
        claims=(
            Claim(
                says="sun and ring rotate on the ground, three planets on the carrier, which is "
                "fixed to the ground",
                ours=f"free to rotate: {', '.join(free)}; held: {', '.join(held)}",
                holds=set(free) == stated and held == ["carrier"],
                kind="number",
            ),
        ),
        remarks="Motor and load are two additional bodies with elastic couplings to "
        f"{scene.drive.input.member} and {scene.drive.output.member}. The paper mentions neither, "
        "but without their inertia the gears would stop within milliseconds.",
        figures={"free": free, "held": held},
    )


def _free_and_held(scene: Scene) -> tuple[list[str], list[str]]:
    """Names of the bodies that rotate in the equations of motion, and of those at rest."""
    gearbox = Gearbox(scene)
    names, ground = gearbox.body_names, gearbox.bodies.ground
    free = [n for n, place in zip(names.names, names.place, strict=True) if place < ground]
    return free, [n for n in names.names if n not in free]


def assembly(evidence: Evidence) -> Entry:
    """Positions of the planets and mesh frequency in sections 2 and 9."""
    scene = evidence.scene
    try:
        check_assembly(scene.gearset.tooth_numbers, np.radians(PRINTED_ANGLES).tolist())
        fits, why = True, ""
    except ValueError as error:
        fits, why = False, str(error)
    angles = ", ".join(f"{math.degrees(a):g}" for a in scene.gearset.planet_angles)
    frequency, ring_held = _meshing_frequency(scene), _meshing_frequency(_with_held_ring(scene))
    return Entry(
        number="Sections 2, 9",
        title="planet positions and meshing frequency",
        claims=(
            Claim(
                says="planets at 90, -30 and 210 deg",
                ours=f"{angles} deg",
                holds=fits,
                kind="number",
                why=why,
            ),
            Claim(
                says="f_m = 350 Hz at 1000 rpm, carrier fixed (1e)",
                ours=f"{frequency:g} Hz",
                printed=f"{ring_held:g} Hz in the damping of `paper_printed`",
                holds=math.isclose(frequency, 350.0),
                kind="number",
                why=f"the last form of (1e), which gives {ring_held:g} Hz, is valid for a held "
                "ring only",
            ),
        ),
        remarks="Equations (1c) to (1e) are valid for a held ring if omega_r is read as the speed "
        "of the carrier. With the carrier fixed, as in Table 1 and section 7, they contradict "
        "(1a).",
        figures={"meshing_frequency": frequency, "meshing_frequency_held_ring": ring_held},
    )


def _meshing_frequency(scene: Scene) -> float:
    """Mesh frequency at the input speed of the scene [Hz]."""
    return abs(float(Layout(scene).cycles[0])) * scene.operating_point.input_speed / math.tau


def _with_held_ring(scene: Scene) -> Scene:
    return scene.replace(**{"gearset.held": "ring", "drive.output.member": "carrier"})


def stick_diagram(evidence: Evidence) -> Entry:
    """Figure 1."""
    scene = evidence.scene
    inputs = [_inputs(evidence.scene), _inputs(load_scene("differential"))]
    return Entry(
        number="Figure 1",
        title="gearbox stick diagram",
        claims=(
            Claim(
                says="sun, three planets, carrier and ring; input at the sun (A), the carrier (B) "
                "or both, output at the ring",
                ours=f"{scene.gearset.planets} planets; input at {' or at '.join(inputs)}; output "
                f"at the {scene.drive.output.member}",
                holds=scene.gearset.planets == 3
                and inputs == ["sun", "sun and carrier"]
                and scene.drive.output.member == "ring",
                kind="number",
            ),
        ),
        remarks="The figure is drawn from the scene `paper`, to scale; the scene `differential` "
        "has both inputs. The drawing of the paper was not available, so the comparison is limited "
        "to the caption and section 2.",
        picture=_draw(scene),
    )


def _inputs(scene: Scene) -> str:
    return " and ".join(machine.member for machine in scene.drive.inputs)


def _draw(scene: Scene) -> Figure:
    figure, (front, section) = panels(2, 3.6)
    _front(drawing(front), scene)
    _section(drawing(section), scene)
    return figure


def _front(axes: Axes, scene: Scene) -> None:
    """Pitch circles seen along the axis [mm]."""
    sun, planet, ring = (
        1e3 * pitch_radius(z, scene.gearset.transverse.module) for z in _teeth(scene)
    )
    axes.add_patch(Circle((0, 0), ring, fill=False, color=GREEN, lw=2))
    axes.add_patch(Circle((0, 0), sun, fill=False, color=BLUE, lw=2))
    for i, angle in enumerate(scene.gearset.planet_angles, 1):
        x, y = (sun + planet) * math.cos(angle), (sun + planet) * math.sin(angle)
        axes.plot([0, x], [0, y], color=GREY, lw=3, solid_capstyle="round", zorder=0)
        axes.add_patch(Circle((x, y), planet, fill=False, color=ORANGE, lw=2))
        axes.plot([x], [y], "o", color=GREY)
        far = 1.3 * ring / (sun + planet) * np.array([x, y]) * (0.9 if i == 1 else 1.0)
        label = f"planet {i}\n{math.degrees(angle):g}°"
        axes.annotate(label, tuple(far), ha="center", va="center", color=ORANGE, fontsize=8.5)
    axes.plot([0], [0], "o", color="black")
    axes.annotate("sun", (0, -0.65 * sun), ha="center", color=BLUE)
    axes.annotate("carrier", (0, 0), xytext=(8, 8), textcoords="offset points", color=GREY)
    axes.annotate("ring", (0, -0.92 * ring), ha="center", color=GREEN)
    axes.set_xlim(-1.4 * ring, 1.4 * ring)
    axes.set_ylim(-1.05 * ring, 1.3 * ring)
    axes.set_title("pitch circles, to scale", loc="center")


def _section(axes: Axes, scene: Scene) -> None:
    """Upper half of the axial section as a stick diagram [mm]; axial lengths are arbitrary."""
    sun, planet, ring = (
        1e3 * pitch_radius(z, scene.gearset.transverse.module) for z in _teeth(scene)
    )
    arm = sun + planet
    axes.plot([-34, 34], [0, 0], color="black", lw=0.8, ls="-.")
    axes.plot([-30, 0, 0], [0, 0, sun], color=BLUE, lw=2.5)
    axes.plot([-5, 5], [sun, sun], color=BLUE, lw=2.5)
    axes.plot([-5, 5], [arm - planet + 0.8] * 2, color=ORANGE, lw=2.5)
    axes.plot([0, 0], [arm - planet + 0.8, arm + planet - 0.8], color=ORANGE, lw=2.5)
    axes.plot([-5, 5], [arm + planet - 0.8] * 2, color=ORANGE, lw=2.5)
    axes.plot([0, 12, 12], [arm, arm, 2.5], color=GREY, lw=2.5)
    axes.plot([12, 17], [2.5, 2.5], color=GREY, lw=2.5)
    axes.plot([-5, 22, 22, 30], [ring, ring, 0, 0], color=GREEN, lw=2.5)
    _ground(axes, 17, 2.5)
    axes.annotate("input A", (-31, 2), color=BLUE, ha="center")
    axes.annotate("output", (31, 2), color=GREEN, ha="center")
    axes.annotate("carrier,\ninput B", (12.7, 9), color=GREY, fontsize=8.5)
    axes.annotate("held", (14.5, -3.5), color=PINK, ha="center")
    axes.annotate("sun", (-7, 0.45 * sun), color=BLUE, ha="right")
    axes.annotate("planet", (-7, arm), color=ORANGE, ha="right")
    axes.annotate("ring", (-7, ring - 1), color=GREEN, ha="right")
    axes.set_xlim(-38, 38)
    axes.set_ylim(-6, 1.1 * ring)
    axes.set_title("upper half of the section", loc="center")


def _ground(axes: Axes, x: float, y: float) -> None:
    axes.plot([x, x], [y - 1.6, y + 1.6], color=PINK, lw=2)
    for k in range(4):
        axes.plot([x, x + 1.2], [y - 1.6 + k, y - 2.4 + k], color=PINK, lw=0.8)


def _teeth(scene: Scene) -> tuple[int, int, int]:
    return scene.gearset.tooth_numbers
