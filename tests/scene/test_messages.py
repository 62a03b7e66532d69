"""Messages about values that are mistyped name what is meant."""

import math

import pytest
import yaml

import planetary_twin_py as pt

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


def test_a_machine_on_the_fixed_member_is_refused():
    def loaded_carrier(data):
        data["gearset"].pop("held")
        data["drive"]["output"]["member"] = "carrier"

    assert "is fixed by gearset.held (default: carrier), so" in parsed(loaded_carrier)
    given = refused(**{"drive.output.member": "carrier"})
    assert "is fixed by gearset.held, so" in given
