"""Runout against involute flanks of gears whose toothing is off its axis.

Two involute gears whose base circles are a distance A apart in a direction psi touch where the sum
of their unwound angles says, a closed form.
"""

import math

import numpy as np
import pytest
from planetary_twin_core_parts import OPEN, contact_event, form_error, place_lines

import planetary_twin_py as pt
from planetary_twin_py._core import BODIES, LINES, MESHES, State, StepConstants, set_step_constants
from planetary_twin_py.model.gearbox import Gearbox
from planetary_twin_py.run.engine import Engine

SIZE = 1e-6  # [m] small beside a tooth: errors are of first order in it
SCENE = pt.load_scene("paper").replace(backlash="60 um")
ANGLE, RADIUS = SCENE.gearset.pressure_angle, Gearbox(SCENE).radii
CENTRE = {"sun": 0.0, "planet": RADIUS["carrier"] / math.cos(ANGLE), "ring": 0.0}
PAIRS = {False: ("sun", "planet"), True: ("planet", "ring")}


def modelled(train, mesh, flank, turn):
    """e [m] with the motor, the sun, `turn` turns on."""
    state, angle = State(), np.zeros((MESHES, LINES))
    state.turns[0], state.fraction[0] = math.floor(turn), turn - math.floor(turn)
    place_lines(train, state, mesh, angle)
    return form_error(train, mesh, float(flank), angle, 0.0, 0.0)[0]


# The direction in which a toothing is off, with the sun at rest and turned: gear, turns per turn of
# the sun as seen from the held carrier, where it begins. Planet 1 meshes with the ring half a cycle
# after the sun, from where the ring's turn is counted.
TURNING = {
    "sun": (1.0, math.pi),
    "planet": (-30 / 20, math.pi),
    "ring": (-30 / 70, 2.0 * math.pi * 0.5 / 70),
}


def involute(cosine):
    """inv a of the working pressure angle a."""
    return math.tan(math.acos(cosine)) - math.acos(cosine)


def closed_form(ring, flank, gear, size, direction):
    """e [m] of a flank: how much less the gears approach than at their nominal centres.

    cos a = (r_1 + r_2)/A of an external mesh, (r_2 - r_1)/A of an internal one. A turn of the line
    of centres shifts both flanks by the same amount; inv a is the distance of each from the middle.
    """
    first, second = PAIRS[ring]
    off = {gear: size * np.exp(1j * direction)}
    between = CENTRE["planet"] + off.get("planet", 0.0) - off.get("ring" if ring else "sun", 0.0)
    radii = RADIUS[second] - RADIUS[first] if ring else RADIUS[first] + RADIUS[second]
    tangential = -radii * np.angle(between)
    radial = (radii if ring else -radii) * (involute(radii / abs(between)) - INVOLUTE)
    return -(tangential + flank * radial)


INVOLUTE = involute(math.cos(ANGLE))


@pytest.mark.parametrize("flank", [1, -1], ids=["drive", "coast"])
@pytest.mark.parametrize(
    ("gear", "ring"), [("sun", False), ("planet", False), ("planet", True), ("ring", True)]
)
def test_runout_is_that_of_the_closed_form_of_involutes(gear, ring, flank):
    """The rest is of second order: 1/10 of the runout leaves 1/100 of it."""
    rate, begin = TURNING[gear]
    left = []
    for size in (2e-5, 2e-6):
        train = Gearbox(SCENE.replace(**{f"mesh.runout.{gear}": size})).train
        mesh = int(train.meshes) // 2 if ring else 0
        turns = np.linspace(0.0, 7.0, 23)
        found = np.array([modelled(train, mesh, flank, turn) for turn in turns])
        directions = begin + 2.0 * math.pi * rate * turns
        exact = [closed_form(ring, flank, gear, size, direction) for direction in directions]
        left.append(abs(found - exact).max())
        assert left[-1] < 0.01 * size
    assert left[1] == pytest.approx(0.01 * left[0], rel=0.05)


@pytest.mark.parametrize("place", [1, 2])
def test_the_sun_is_off_by_the_same_towards_every_planet(place):
    train = Gearbox(SCENE.replace(**{"mesh.runout.sun": SIZE})).train
    angles = SCENE.gearset.planet_angles
    for flank in (1, -1):
        for turn in (0.0, 0.3, 2.9):
            direction = math.pi + 2.0 * math.pi * turn - (angles[place] - angles[0])
            expected = closed_form(False, flank, "sun", SIZE, direction)
            assert modelled(train, place, flank, turn) == pytest.approx(expected, abs=2e-3 * SIZE)


def test_the_play_breathes_by_the_radial_part():
    """Two flanks leave B + 2 e_R between them: the tangential part shifts both equally."""
    train = Gearbox(SCENE.replace(**{"mesh.runout.sun": SIZE})).train
    play = [modelled(train, 0, 1, turn) - modelled(train, 0, -1, turn) for turn in (0.0, 0.25, 0.5)]
    widest = 2.0 * SIZE * math.sin(ANGLE)
    assert play == pytest.approx([widest, 0.0, -widest], abs=1e-12)


@pytest.mark.parametrize("turn", [0.1, 0.45, 0.8])
@pytest.mark.parametrize("shift", [-2e-7, 1e-7])
def test_an_open_mesh_closes_where_the_nearer_of_its_flanks_is(turn, shift):
    engine = Engine(SCENE.replace(**{"mesh.runout.sun": SIZE}, backlash="3 um"), 1e-3)
    model, state, moment = engine.model, engine.integrator.end, StepConstants()
    state.side[:] = OPEN
    state.x[:] = 0.0
    state.x[model.train.sun] = shift
    state.fraction[0] = turn
    set_step_constants(model, state, moment)
    found = contact_event(model, state, moment, 0, state.x, np.zeros(BODIES), (0.0, 0.0, 0.0))
    drive, coast = (modelled(model.train, 0, flank, turn) for flank in (1, -1))
    nearest = min(1.5e-6 - shift + drive, 1.5e-6 + shift - coast)
    assert found == pytest.approx(nearest, abs=1e-3 * SIZE)  # the shift turns the sun a little
