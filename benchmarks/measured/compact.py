"""The COMPAct test rig: lost motion, stiffness and spectral lines.

Repository singhaman1750/COMPAct, ICRA 2026, arXiv 2510.07197, MIT licence.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import cache

import numpy as np
from numpy.typing import NDArray

import planetary_twin_py as pt
from planetary_twin_py.studies.lost_motion import LostMotion, lost_motion

from .compact_readings import highest_between, measured_line
from .compact_twist import (
    STIFFNESS_SPAN,
    lost_motion_in,
    resting_places,
    twist_loop,
)
from .row import INPUT, MISSES, UNDECIDED, Row, verdict

SCENE = "compact_actuator"
PUBLISHED_STIFFNESS = 242.7  # [N m/rad]
TEST_TORQUE = 7.2  # [N m] on the output: that of the operating point
CLEAR = 1.2  # times the highest value where the twin has no line
RESOLUTION = 0.25  # orders of the measured spectrum
CARRIER_SPEED = 10.0 / 60.0  # [turns/s] of the output while the spectra were measured


def rig_lost_motion() -> Iterator[Row]:
    """Lost motion: backlash from the first half of the readings, predicted for the second half."""
    scene = pt.load_scene(SCENE).replace(dynamics="quasi_static")
    first, second = lost_motion_in(0.0, 0.5), lost_motion_in(0.5, 1.0)
    backlash = first * _pin_lever(scene)
    predicted = _play(scene.replace(backlash=backlash))
    yield Row(
        "lost motion at the output, range of second half of the readings",
        f"{math.degrees(second):.3f} deg",
        f"{math.degrees(predicted):.3f} deg from a backlash of {1e3 * backlash:.3f} mm, which "
        "gives the range of the first half",
        verdict(abs(predicted / second - 1.0) < 0.1),
        "bound: 10 %. One figure of one test: it shows that the lost motion is the same ten "
        "seconds later.",
    )
    whole = lost_motion_in(0.0, 1.0)
    backlash = scene.operating_point.backlash
    yield Row(
        "lost motion at the output, range of all readings (published: 0.59 deg)",
        f"{math.degrees(whole):.3f} deg",
        f"{math.degrees(_play(scene)):.3f} deg from a backlash of {1e3 * backlash:.3f} mm in the "
        f"scene; {math.degrees(_test().lost_motion):.3f} deg by the command `lost-motion`, with "
        "friction, at 3 % of the torque",
        INPUT,
        "backlash is a parameter; the row only shows that the scene has this lost motion.",
    )
    low, high = resting_places()
    yield Row(
        "lost motion between the two most frequent positions of the output",
        f"{math.degrees(high - low):.2f} deg",
        f"{math.degrees(_play(scene)):.3f} deg",
        MISSES,
        "the published range is the distance of the two outermost of 6492 readings. Most readings "
        "are closer together: the lost motion varies over the turn, or teeth do not reach the "
        "flank. The twin has one backlash for all teeth.",
    )


def rig_stiffness() -> Iterator[Row]:
    """Stiffness at the output, published and from the readings."""
    scene = pt.load_scene(SCENE).replace(dynamics="quasi_static")
    teeth = _teeth_stiffness(scene)
    whole = 1.0 / (1.0 / teeth + 1.0 / scene.drive.output.coupling_stiffness)
    loop, ratio = twist_loop(), 1.0 + scene.gearset.teeth.ring / scene.gearset.teeth.sun
    yield Row(
        "stiffness at the output, published",
        f"{PUBLISHED_STIFFNESS} N m/rad",
        f"{whole:.0f} N m/rad: teeth {teeth:.3g}, output coupling "
        f"{scene.drive.output.coupling_stiffness:g}; {_test().stiffness_with_couplings:.0f} "
        "N m/rad by the command `lost-motion`, with friction and the coupling of the motor",
        INPUT,
        "the coupling has the compliance of pins, bearings, shafts and housing, all of printed "
        "plastic. It is chosen so that the scene has the published stiffness.",
    )
    yield Row(
        "stiffness of the readings, if their angle is that of the output",
        f"{loop.chord:.1f} N m/rad between both ends of the loop, {loop.slope:.1f} as the slope of "
        "a straight line through it",
        f"{whole:.0f} N m/rad",
        MISSES,
        "the file of readings does not state the shaft of its encoder. With this assumption, the "
        "stiffness is an eighth to a tenth of the published one.",
    )
    low, high = ratio * loop.chord, ratio * loop.unloading
    yield Row(
        "stiffness of the readings, if their angle is that of the motor shaft",
        f"{low:.0f} N m/rad between both ends of the loop; loading above "
        f"{STIFFNESS_SPAN:g} N m {ratio * loop.loading:.0f}, unloading {high:.0f}",
        f"{whole:.0f} N m/rad",
        verdict(abs(whole / low - 1.0) < 0.3),
        "bound: 30 % of the first figure. The twin is linear, the rig is not. The readings are "
        "close to the published figure only if the angle is that of the motor shaft, 7.2 times "
        "that of the output.",
    )
    held = 2.0 * ratio * scene.losses.sun_drag.coulomb / whole
    yield Row(
        "width of the loop at zero torque",
        f"{math.degrees(loop.width):.0f} deg, {math.degrees(loop.width / ratio):.1f} deg if it is "
        "that of the motor shaft",
        f"{math.degrees(held + _play(scene)):.2f} deg: lost motion, and twist that the drag holds",
        verdict(abs((held + _play(scene)) * ratio / loop.width - 1.0) < 0.5),
        "bound: 50 %. The plastic creeps, and its static friction is higher than the friction in "
        "the steady runs; the twin models neither.",
    )


@cache
def _test() -> LostMotion:
    """The test of the command `lost-motion`."""
    return lost_motion(pt.load_scene(SCENE), TEST_TORQUE)


def _pin_lever(scene: pt.Scene) -> float:
    """Distance that turns a DTE of both meshes of a planet into an angle of the carrier [m]."""
    gears = scene.gearset
    centre = 0.5 * gears.transverse.module * (gears.teeth.sun + gears.teeth.planet)
    return float(centre * np.cos(gears.transverse.pressure_angle))


def _twist(scene: pt.Scene, torque: float) -> float:
    """Angle of the carrier [rad] against a held sun, under a torque at the sun [N m]."""
    free = {"lubrication.friction": False, "losses.sun_drag.coulomb": 0.0}
    dte = pt.simulate(scene.replace(input_torque=torque, **free), 0.2).mesh["dte_mean"]
    return float(np.mean(dte[:3] + dte[3:]) / (2.0 * _pin_lever(scene)))


def _play(scene: pt.Scene) -> float:
    return _twist(scene, 1e-3) - _twist(scene, -1e-3)


def _teeth_stiffness(scene: pt.Scene) -> float:
    ratio = 1.0 + scene.gearset.teeth.ring / scene.gearset.teeth.sun
    return 2.0 * ratio / (_twist(scene, 2.5) - _twist(scene, 0.5))


def rig_orders() -> Iterator[Row]:
    """Lines in the spectrum of one sun mesh, whose gears have runout."""
    scene = pt.load_scene(SCENE).replace(
        **{"dynamics": "quasi_static", "mesh.runout": {"sun": 2e-5, "planet": 2e-5}},
        backlash=2e-4,
        input_speed=2.0 * np.pi * 7.2 * CARRIER_SPEED,
    )
    zs, zp, zr = scene.gearset.teeth.sun, scene.gearset.teeth.planet, scene.gearset.teeth.ring
    rate = 400.0
    force = pt.simulate(scene, 200.0, sample_rate=rate).mesh_force[:, 0]
    spectrum = pt.amplitude_spectrum(force, rate)
    order = spectrum.frequency / CARRIER_SPEED
    planet, sun = zr / zp, zr / zs  # orders of their turns against the carrier
    lines = {
        "mesh line, per turn of the output": zr,
        "sideband: mesh - planet": zr - planet,
        "sideband: mesh + planet": zr + planet,
        "sideband: mesh - sun": zr - sun,
        "sideband: mesh + motor": zr + sun + 1.0,
    }
    for what, cause in lines.items():
        measured, height = measured_line(cause)
        clear = height > CLEAR * highest_between()
        found = _nearest_line(order, spectrum.amplitude, measured)
        same = abs(found - cause) < 0.01
        yield Row(
            what,
            f"{measured:.2f}, {height:.1f} times the median",
            f"{found:.2f}",
            verdict(abs(found - measured) < RESOLUTION) if same and clear else UNDECIDED,
            f"bound: {RESOLUTION} orders, the resolution of one run. The twin's line is the "
            "nearest in the force of one sun mesh with at least a tenth of the height of the mesh "
            "line. A runout of 20 um is assumed. The lines of the rig are in its motor speed, mean "
            "of 18 runs up to 10 rpm. "
            + ("" if same else "The twin's line is mesh + 3 planet, too near to be separated. ")
            + ("" if clear else "The line of the rig is not above the noise."),
        )


def _nearest_line(
    order: NDArray[np.float64], amplitude: NDArray[np.float64], place: float
) -> float:
    """The order nearest to `place` of a line with a tenth of the height of the mesh line."""
    near = np.abs(order - 155.0) < 10.0
    lines = pt.strongest_lines(order[near], amplitude[near], 100)
    high = [line.place for line in lines if line.amplitude > 0.1 * lines[0].amplitude]
    return min(high, key=lambda found: abs(found - place))
