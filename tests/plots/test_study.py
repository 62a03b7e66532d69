"""A plot shows the values of the table, in engineering units."""

import itertools

import numpy as np
import pyarrow as pa
import pytest
from matplotlib.collections import PathCollection
from plots.tables import study

import planetary_twin_py as pt

SPEEDS = tuple(pt.rpm(speed) for speed in (1000.0, 2000.0, 3000.0))
TORQUES = (10.0, 20.0)
MANY = tuple(pt.rpm(speed) for speed in range(1000, 9000, 1000))


def efficiency(speed, torque=20.0, *_):
    return 0.98 + 1e-5 * speed + 1e-4 * torque


def drawn(axes):
    """Values of each curve."""
    return {line.get_label(): np.array(line.get_data()) for line in axes.get_lines()}


def test_one_field_is_a_curve_in_rpm_and_per_cent():
    table = study({"input_speed": SPEEDS}, {"efficiency": efficiency, "power_loss": efficiency})
    (axes,) = pt.plot_study(table).axes
    ((x, y),) = drawn(axes).values()
    assert x == pytest.approx([1000.0, 2000.0, 3000.0])
    assert y == pytest.approx([100.0 * efficiency(speed) for speed in SPEEDS])
    assert axes.get_xlabel() == "Speed set-point [rpm]" and axes.get_ylabel() == "Efficiency [%]"


def test_a_second_field_is_a_curve_for_each_of_its_values():
    table = study({"input_speed": SPEEDS, "input_torque": TORQUES}, {"efficiency": efficiency})
    figure = pt.plot_study(table)
    curves = drawn(figure.axes[0])
    assert list(curves) == ["10", "20"]
    for torque in TORQUES:
        expected = [100.0 * efficiency(speed, torque) for speed in SPEEDS]
        assert curves[f"{torque:g}"][1] == pytest.approx(expected)
    (legend,) = figure.legends
    assert legend.get_title().get_text() == "Input torque [N m]"


def test_a_third_field_is_a_panel_for_each_of_its_values():
    fields = {"input_speed": SPEEDS, "input_torque": TORQUES, "backlash": (2e-7, 3e-7)}
    axes = pt.plot_study(study(fields, {"efficiency": lambda s, t, b: 1e6 * b})).axes
    assert [pane.get_title(loc="left") for pane in axes] == ["Backlash 0.2 µm", "Backlash 0.3 µm"]
    assert axes[0].get_ylim() == axes[1].get_ylim()
    for curve in drawn(axes[1]).values():
        assert curve[1] == pytest.approx([30.0] * 3)


def test_two_fields_are_a_map_with_a_gap_at_a_failed_point():
    fields = {"input_speed": MANY, "input_torque": tuple(np.linspace(5.0, 60.0, 7))}
    figure = pt.plot_study(study(fields, {"efficiency": efficiency}, failed=(24,)))
    axes, bar = figure.axes
    assert axes.get_xlabel() == "Speed set-point [rpm]"
    assert axes.get_ylabel() == "Input torque [N m]"
    assert bar.get_ylabel() == "Efficiency [%]"
    ((x, _),) = drawn(axes).values()
    assert len(x) == len(MANY) * 7 - 1
    filled = axes.collections[0]
    low, high = filled.get_clim()
    values = [100.0 * efficiency(s, t) for s, t in itertools.product(*fields.values())]
    assert low <= min(values) and max(values) <= high
    assert figure.get_supxlabel() == "1 of 56 points failed and are omitted"

    def is_filled(speed, torque):
        place = 30.0 / np.pi * MANY[speed], fields["input_torque"][torque]
        return any(path.contains_point(place) for path in filled.get_paths() if len(path))

    assert divmod(24, 7) == (3, 3)
    assert not is_filled(3, 3) and is_filled(2, 2) and is_filled(5, 4)


CLIPPED = {
    "efficiency": efficiency,
    "sun_planet_viscous_friction_clipped": lambda speed, *_: 0.5 if speed < SPEEDS[1] else 0.005,
    "planet_ring_viscous_friction_clipped": lambda *_: 0.0,
}


def hollow(axes):
    """Points that are drawn hollow."""
    marks = [each for each in axes.collections if isinstance(each, PathCollection)]
    return [tuple(place) for each in marks for place in each.get_offsets()]


@pytest.mark.parametrize("kind", ["curves", "map"])
def test_points_with_clipped_friction_are_hollow(kind):
    fields = {"input_speed": SPEEDS, "input_torque": (20.0, 40.0)}
    figure = pt.plot_study(study(fields, CLIPPED), kind=kind)
    speed = 30.0 / np.pi * SPEEDS[0]
    places = {
        "map": [(speed, 20.0), (speed, 40.0)],
        "curves": [(speed, 100.0 * efficiency(SPEEDS[0], torque)) for torque in (20.0, 40.0)],
    }
    assert hollow(figure.axes[0]) == [pytest.approx(place) for place in places[kind]]
    assert "hollow: viscous friction is clipped" in figure.get_supxlabel()


def test_a_stribeck_curve_is_hollow_where_friction_is_clipped():
    figures = {
        f"{side}_{name}": (lambda speed, value=value: value * speed)
        for side in ("sun_planet", "planet_ring")
        for name, value in {
            "lambda_ratio": 0.01,
            "mesh_force_mean": 10.0,
            "boundary_friction": 0.1,
            "viscous_friction": 0.2,
        }.items()
    }
    sun, ring = pt.plot_study(
        study({"input_speed": SPEEDS}, CLIPPED | figures), kind="stribeck"
    ).axes
    assert hollow(sun) == [pytest.approx((0.01 * SPEEDS[0], 0.03))] and hollow(ring) == []


@pytest.mark.parametrize(
    ("given", "reason"),
    [
        ({"measures": ["efficency"]}, "y = 'efficency': .*efficiency"),
        ({"x": "input_sped"}, "x = 'input_sped': .*input_speed"),
        ({"by": "nothing"}, "by = 'nothing'"),
        ({"kind": "pie"}, "kind = 'pie': must be one of curves, map, points, histogram, stribeck"),
        ({"kind": "map"}, "a map needs two numerical fields"),
        ({"kind": "stribeck"}, "sun_planet_lambda_ratio"),
    ],
)
def test_an_undrawable_request_is_refused_in_one_line(given, reason):
    table = study({"input_speed": SPEEDS}, {"efficiency": efficiency})
    with pytest.raises(ValueError, match=reason) as refusal:
        pt.plot_study(table, **given)
    assert "\n" not in str(refusal.value)


def test_a_table_without_results_is_refused():
    table = pa.table({"input_speed": SPEEDS, "pressure": SPEEDS})
    with pytest.raises(ValueError, match="y: no column is a result of a study"):
        pt.plot_study(table)


def test_more_than_three_fields_are_points_over_each():
    fields = {
        "input_speed": SPEEDS[:2],
        "input_torque": TORQUES,
        "backlash": (2e-7, 3e-7),
        "lambda_ratio": (1.0, 2.0),
    }
    axes = pt.plot_study(study(fields, {"efficiency": lambda s, t, *_: 0.9 + 1e-3 * t})).axes
    assert len(axes) == 4
    ((x, y),) = drawn(axes[1]).values()
    assert axes[1].get_xlabel() == "Input torque [N m]" and len(x) == 16
    assert y == pytest.approx(90.0 + 0.1 * x)


def test_a_histogram_counts_each_point_and_marks_percentiles():
    fields = {"input_torque": tuple(np.linspace(5.0, 60.0, 101))}
    table = study(fields, {"efficiency": lambda t: 1e-2 * t})
    (axes,) = pt.plot_study(table, kind="histogram").axes
    assert sum(bar.get_height() for bar in axes.patches) == 101
    marks = [line.get_xdata()[0] for line in axes.get_lines()]
    assert marks == pytest.approx([5.0 + 55.0 * share for share in (0.05, 0.5, 0.95)])
