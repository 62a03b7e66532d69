"""Texts on the command line become values of scene fields."""

import pytest

import planetary_twin_py as pt
from planetary_twin_py.studies.axes import Axis, read_axis

PAPER = pt.load_scene("paper")


@pytest.mark.parametrize(
    ("field", "text", "values"),
    [
        ("backlash", "0.2 um:0.4 um:3", [2e-7, 3e-7, 4e-7]),
        ("lubrication.viscosity", "0.01:1:3:log", [0.01, 0.1, 1.0]),
        ("input_speed", "-100:100:5", [-100.0, -50.0, 0.0, 50.0, 100.0]),
        ("input_speed", "1000rpm,2000rpm", [pt.rpm(1000), pt.rpm(2000)]),
        ("input_torque", "5,5,7", [5.0, 7.0]),
    ],
)
def test_lists_grids_and_equal_ratios_are_read_with_their_units(field, text, values):
    axis = read_axis(PAPER, field, text)
    assert isinstance(axis, Axis) and axis.field == field
    assert axis.values == pytest.approx(values, rel=1e-12)


def test_ends_of_a_grid_equal_the_given_values_bit_for_bit():
    values = read_axis(PAPER, "lubrication.viscosity", "0.013:0.97:7:log").values
    assert (values[0], values[-1]) == (0.013, 0.97)


@pytest.mark.parametrize(
    ("field", "text", "reason"),
    [
        ("nosuch", "1:2:3", "nosuch: no such field"),
        ("backlash", "1:2:3", r"backlash = 1\.0: must be a number within 0 and 0\.001 m"),
        ("backlash", "1e-7:2e-7:x", r"'1e-7:2e-7:x': 'x' must be a count within 2 and"),
        ("backlash", "1e-7:1e-7:3", r"both ends are equal"),
        ("backlash", "0:1e-7:3:log", r"must have the same sign"),
        ("dynamics", "torsional:quasi_static:2", r"is not a number; list its values"),
        (
            "input_speed",
            "1000,2000 rpm",
            r"'1000,2000 rpm': 1000 has no unit; write a unit with each",
        ),
        ("input_torque", "40,5 N m:50 N m:3", r"'40,5 N m': write a decimal point"),
    ],
)
def test_invalid_axis_is_refused_in_one_line_that_names_field(field, text, reason):
    with pytest.raises(ValueError, match=reason) as refusal:
        read_axis(PAPER, field, text)
    assert "\n" not in str(refusal.value) and field in str(refusal.value)
