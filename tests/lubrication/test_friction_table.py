"""A friction law of one's own as a table: it gives what the law gives, between its values too."""

import math

import numpy as np
import pytest
from planetary_twin_core_parts import lambda_ratio_of

import planetary_twin_py as pt
from planetary_twin_py._core import tooth_contact
from planetary_twin_py.model.oil import build_oil

PAPER = pt.load_scene("paper").replace(
    **{"lubrication.traction": "eyring", "lubrication.boundary": "load_sharing"}
)
RATIOS = np.geomspace(0.05, 5.0, 9)
PRESSURES = np.geomspace(5e7, 2e9, 7)
SPEEDS = np.geomspace(1e-3, 3.0, 16)


def with_table(table, **changes):
    changes = {"lubrication.traction": "table", "lubrication.friction_table": table, **changes}
    return PAPER.replace(**changes)


def friction(scene, pair):
    """Of a tooth pair: signed [N], boundary and viscous [N], sliding [m/s], slope [N s/m]."""
    oil = build_oil(scene, scene.operating_point)
    signed, boundary, viscous, log_film, sliding, slope, *_ = tooth_contact(oil, pair)
    return signed, boundary + viscous, sliding, slope, lambda_ratio_of(oil, log_film)


def pair_of(load, slide_to_roll=0.3, speed=1.0, radius=5e-3):
    """Equal radii of curvature, rolling at `speed` [m/s]."""
    fast, slow = (speed * (1.0 + sign * 0.5 * slide_to_roll) for sign in (1.0, -1.0))
    return radius, radius, 1.0, fast / radius, -slow / radius, load


def test_a_constant_is_dry_friction():
    scene = with_table(pt.friction_table(lambda: 0.07))
    signed, magnitude, sliding, *_ = friction(scene, pair_of(100.0))
    assert magnitude == pytest.approx(7.0, rel=1e-6)
    assert math.copysign(1.0, signed) == math.copysign(1.0, sliding)


@pytest.mark.parametrize(
    ("name", "values", "factor"),
    [
        ("lambda_ratio", [0.5, 1.0, 2.0], 0.04),
        ("pressure", [1e7, 1e8, 1e9], 1e-3),
        ("rolling_speed", [0.1, 1.0, 10.0], 0.02),
        ("sliding_speed", [0.01, 0.1, 1.0], 0.02),
    ],
)
def test_the_table_is_linear_in_logarithms_between_values(name, values, factor):
    """Taken from what the contact itself has: lambda, F/(2 b L), mean speed and sliding speed."""
    law = {
        "lambda_ratio": lambda lambda_ratio: factor * math.log(20.0 * lambda_ratio),
        "pressure": lambda pressure: factor * math.log(pressure),
        "rolling_speed": lambda rolling_speed: factor * math.log(100.0 * rolling_speed),
        "sliding_speed": lambda sliding_speed: factor * math.log(500.0 * sliding_speed),
    }[name]
    scene = with_table(
        pt.friction_table(law, **{name: values}), **{"lubrication.lambda_ratio": "prescribed"}
    )
    load, radius = 200.0, 5e-3
    for ratio in (0.7, 1.6):
        at = scene.replace(lambda_ratio=ratio)
        oil = build_oil(at, at.operating_point)
        pressure = load / (math.exp(oil.log_area) * math.sqrt(0.5 * radius * load))
        here = {
            "lambda_ratio": ratio,
            "pressure": pressure,
            "rolling_speed": 1.3,
            "sliding_speed": 0.39,
        }
        _, magnitude, *_ = friction(at, pair_of(load, 0.3, 1.3, radius))
        assert values[0] < here[name] < values[-1]
        assert magnitude / load == pytest.approx(law(here[name]), rel=1e-6)


def test_beyond_its_values_it_is_constant():
    table = pt.friction_table(lambda sliding_speed: 0.05 * sliding_speed, sliding_speed=[0.1, 0.2])
    for ratio, expected in ((0.01, 0.005), (0.9, 0.01)):
        _, magnitude, *_ = friction(with_table(table), pair_of(100.0, ratio))
        assert magnitude == pytest.approx(100.0 * expected, rel=1e-6)


def test_its_slope_is_that_of_friction_over_the_sliding_speed():
    """By differences, where sense and coefficient both change with the sliding."""
    table = pt.friction_table(
        lambda sliding_speed: 0.1 / (1.0 + sliding_speed), sliding_speed=SPEEDS
    )
    scene = with_table(table)
    for ratio in (0.004, 0.01, 0.05, 0.3):
        before, _, low, *_ = friction(scene, pair_of(100.0, ratio * (1.0 - 1e-6)))
        after, _, high, *_ = friction(scene, pair_of(100.0, ratio * (1.0 + 1e-6)))
        slope = friction(scene, pair_of(100.0, ratio))[3]
        assert slope == pytest.approx((after - before) / (high - low), rel=1e-4, abs=1e-6)


def built_in_law():
    """The coefficient of the built-in law at a lambda ratio, pressure and speeds."""
    oils = {
        float(ratio): build_oil(scene, scene.operating_point)
        for ratio in RATIOS
        for scene in [PAPER.replace(**PRESCRIBED, lambda_ratio=float(ratio))]
    }
    radius = 2e-3

    def law(lambda_ratio, pressure, sliding_speed):
        oil = oils[lambda_ratio]
        load = (pressure * math.exp(oil.log_area)) ** 2 * 0.5 * radius
        pair = pair_of(load, sliding_speed / ROLLING, ROLLING, radius)
        _, boundary, viscous, *_ = tooth_contact(oil, pair)
        return (boundary + viscous) / load

    return law


PRESCRIBED = {"lubrication.lambda_ratio": "prescribed"}
ROLLING = 0.625  # [m/s] at the pitch point of `paper` at 1000 rpm


def test_a_table_of_the_built_in_law_gives_its_losses():
    """Evans' and Johnson's coefficient depends on film and rolling speed only weakly: 2 %."""
    table = pt.friction_table(
        built_in_law(), lambda_ratio=RATIOS, pressure=PRESSURES, sliding_speed=SPEEDS
    )
    for ratio in (0.5, 1.5, 3.0):
        runs = [
            pt.simulate(scene.replace(**PRESCRIBED, lambda_ratio=ratio), 0.1, 1000.0)
            for scene in (PAPER, with_table(table))
        ]
        built_in, tabulated = (run.energy.friction for run in runs)
        assert tabulated == pytest.approx(built_in, rel=0.02)
        assert runs[1].energy.residual == pytest.approx(0.0, abs=1e-4 * runs[1].energy.input)


@pytest.mark.parametrize(
    ("changes", "text"),
    [
        ({"lubrication.traction": "table"}, "requires friction_table"),
        ({"lubrication.friction_table.coefficient": [0.1, 0.2]}, "must have 1"),
        ({"lubrication.friction_table.coefficient": [1.5]}, "must be within 0 and 1"),
        (
            {
                "lubrication.friction_table.pressure": [2e8, 1e8],
                "lubrication.friction_table.coefficient": [0.1, 0.2],
            },
            "must be positive and ascending",
        ),
    ],
    ids=str,
)
def test_a_table_that_cannot_be_is_refused_in_one_line(changes, text):
    with pytest.raises(pt.SceneError, match=text) as error:
        PAPER.replace(**changes)
    assert "\n" not in str(error.value)


def test_an_unknown_quantity_is_refused_and_named():
    with pytest.raises(ValueError, match=r"^temperature: no such quantity; must be one of lambda"):
        pt.friction_table(lambda temperature: 0.1, temperature=[300.0, 400.0])
