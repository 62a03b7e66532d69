"""Modes of gear sets in which planets carry no load in static equilibrium."""

import math

import numpy as np
import pytest
from planar.moving_scenes import evenly, planar
from power_flows import FLOWS, scene_of

import planetary_twin_py as pt
from planetary_twin_py.modal.campbell import resonances
from planetary_twin_py.modal.natural import carrying_planets, spring_model
from planetary_twin_py.text.warning_types import AccuracyWarning

ANGLES = evenly(5)
AWAY = 1e-4  # [m] counter-clockwise, which takes the load off a pin, as the sun drives that way


def displaced(pin=AWAY, **changes):
    """The paper's gears with the carrier held and the pin of planet 1 off its place."""
    given = {"gearset.planet_angles": ANGLES, "errors.pin_tangential": (pin, 0.0, 0.0, 0.0, 0.0)}
    return scene_of(FLOWS[0], **(given | {"backlash": 1e-3, "input_torque": 10.0} | changes))


def test_a_planet_without_meshes_turns_freely():
    """With the carrier held a planet without load has no part in the motion of the others."""
    scene = displaced()
    assert carrying_planets(scene, "torsional") == (0.0, 1.0, 1.0, 1.0, 1.0)
    others = scene_of(FLOWS[0], **{"gearset.planet_angles": ANGLES[1:]})
    found, expected = pt.natural_modes(scene), pt.natural_modes(others)
    assert found.frequencies == pytest.approx([0.0, *expected.frequencies])
    assert found.kinds == ("rigid", *expected.kinds)


def test_planets_whose_load_one_carries_alone_have_no_stiffness():
    scene = displaced(-AWAY)
    assert carrying_planets(scene, "torsional") == (1.0, 0.0, 0.0, 0.0, 0.0)
    assert pt.natural_modes(scene).kinds.count("rigid") == 5


def test_all_planets_count_as_in_contact_without_a_torque():
    assert carrying_planets(displaced(input_torque=0.0), "torsional") == (1.0,) * 5


def test_a_planet_that_carries_at_times_has_its_mean_stiffness():
    """Thick teeth of a planet with runout carry while they are at the flanks."""
    scene = planar(
        **{
            "gearset.planet_angles": evenly(4),
            "mesh.runout.planet": 5e-5,
            "errors.planet_runout_phases": (0.0, 1.0, 2.5, 4.0),
            "input_torque": 1.0,
            "backlash": 1e-3,
        }
    )
    shares = carrying_planets(scene, "planar")
    assert any(0.0 < share < 1.0 for share in shares)
    springs = [s for s in spring_model(scene, "planar", "mean").springs if s.kind == "sun_planet"]
    touching = spring_model(scene.replace(**{"mesh.runout.planet": 0.0}), "planar", "mean")
    whole = next(s.stiffness for s in touching.springs if s.kind == "sun_planet")
    assert [s.stiffness for s in springs] == pytest.approx(np.array(shares) * whole)


def test_open_meshes_take_no_part_in_what_the_meshing_excites():
    scene = displaced()
    others = scene_of(FLOWS[0], **{"gearset.planet_angles": ANGLES[1:]})
    felt = [
        [r.excitation for r in resonances(s, pt.natural_modes(s), spring_model(s), math.inf)]
        for s in (scene, others)
    ]
    assert felt[0] == felt[1]


def test_planar_matrix_lacks_the_meshes_of_a_planet_without_load():
    """K without both meshes of planet 1, from the rows of the meshes (Lin and Parker 1999)."""
    scene = planar(
        **{
            "gearset.planet_angles": evenly(4),
            "errors.pin_tangential": (AWAY, 0.0, 0.0, 0.0),
            "backlash": 1e-3,
            "input_torque": 1.0,
        }
    )
    assert carrying_planets(scene, "planar") == (0.0, 1.0, 1.0, 1.0)
    loaded = spring_model(scene.replace(errors={}), "planar")
    place = [name.startswith("planet_1") for name in loaded.coordinates]
    matrix = loaded.stiffness
    for spring in loaded.springs:
        if spring.kind in ("sun_planet", "planet_ring") and spring.row[place].any():
            matrix -= spring.stiffness * np.outer(spring.row, spring.row)
    scale = 1.0 / np.sqrt(loaded.mass)
    squares = np.linalg.eigvalsh(matrix * np.outer(scale, scale))
    expected = np.sqrt(np.maximum(squares, 0.0)) / (2.0 * math.pi)
    assert pt.natural_modes(scene).frequencies == pytest.approx(expected, rel=1e-6, abs=0.1)


def test_without_a_static_load_all_planets_count_as_loaded():
    soft = pt.load_scene("floating_sun").replace(**{"supports.planet.bearing": 1e3})
    with pytest.warns(AccuracyWarning, match="all planets count as loaded, because"):
        pt.natural_modes(soft, "planar")
