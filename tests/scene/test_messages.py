"""Messages about values that are mistyped name what is meant."""

import math

import pytest
import yaml
from paths import planet_ring_path

import planetary_twin_py as pt
from planetary_twin_py.gearset.kinematics import Teeth
from planetary_twin_py.plots.quantity import find

PAPER = pt.load_scene("paper")


def refused(**changes):
    with pytest.raises(pt.SceneError) as error:
        PAPER.replace(**changes)
    return str(error.value)


def parsed(change):
    """The message about a scene file, changed by a function."""
    data = PAPER.model_dump(mode="json")
    change(data)
    with pytest.raises(pt.SceneError) as error:
        pt.parse_scene(yaml.safe_dump(data))
    return str(error.value)


@pytest.mark.parametrize("planets", [1, 8])
def test_a_wrong_number_of_planets_has_the_possible_ones(planets):
    angles = tuple(2.0 * math.pi * n / planets for n in range(planets))
    line = refused(**{"gearset.planet_angles": angles})
    assert line == f"gearset.planet_angles: has {planets} entries: must have 2 to 7"


@pytest.mark.parametrize(
    "field, example",
    [
        ("gearset.planet_angles", "[0 deg, 120 deg]"),
        ("errors.pin_radial", "[20 um, 0 um]"),
        ("errors.planet_stiffness", None),
    ],
)
@pytest.mark.parametrize("number", [3, 0.5, "3 deg"])
def test_a_number_in_place_of_a_list_is_said_to_be_no_list(field, example, number):
    line = refused(**{field: number})
    assert line.startswith(f"{field} = ")
    assert "must be a list, e.g. [" in line
    assert example is None or example in line


def test_an_empty_field_is_said_to_be_empty():
    line = parsed(lambda data: data["gearset"].update(face_width=None))
    assert line.startswith("gearset.face_width = None: must be a number within 0 and 5 m")
    assert line.endswith("the field is empty")


@pytest.mark.parametrize(
    "field, unit, meant",
    [("input_torque", "KN m", "kN m"), ("lubrication.shear_stress", "mpa", "MPa")],
)
def test_a_unit_in_other_letters_is_refused_with_the_right_ones(field, unit, meant):
    line = refused(**{field: f"5 {unit}"})
    assert f"= '5 {unit}': [{unit}] cannot be converted to " in line
    assert line.endswith(f"; write {meant}")


def test_a_machine_on_the_fixed_member_is_refused():
    def loaded_carrier(data):
        data["gearset"].pop("held")
        data["drive"]["output"]["member"] = "carrier"

    assert "is fixed by gearset.held (default: carrier), so" in parsed(loaded_carrier)
    given = refused(**{"drive.output.member": "carrier"})
    assert "is fixed by gearset.held, so" in given


def test_tips_below_a_base_circle_name_their_gear():
    """Line of action from the pitch point to the base circle of the planet: z/2 sin(alpha)."""
    with pytest.raises(ValueError) as error:
        planet_ring_path(Teeth(36, 18, 72), math.radians(20.0), 1.0)
    line = str(error.value)
    assert line.startswith("gearset.teeth.planet = 18: tips of the ring reach below")
    assert "base circle of the planet" in line
    assert f"must be below {9.0 * math.sin(math.radians(20.0)):.3f}" in line
    assert "gearset.profile_shift" in line and "gearset.pressure_angle" in line


@pytest.mark.parametrize("angles", [(0, 180, 300), (0, 180)])
def test_degrees_without_their_unit_are_refused(angles):
    assert "an angle without a unit is in rad" in refused(**{"gearset.planet_angles": angles})


def test_an_unknown_column_is_refused_with_the_one_meant():
    known = dict.fromkeys(("efficiency", "power_loss", "mesh_frequency"))
    with pytest.raises(ValueError, match="no such column; the table has") as error:
        find(known, "efficency", "--y")
    assert all(name in str(error.value) for name in known)
    assert str(error.value).endswith("did you mean efficiency?")
