"""Order tracking of a run-up whose orders are known."""

from fractions import Fraction

import numpy as np
import pytest

import planetary_twin_py as pt
from planetary_twin_py.analysis.lines.mesh_spectrum import order_spectrum_of
from planetary_twin_py.analysis.signals.signal import Signal
from planetary_twin_py.gearset.kinematics import Teeth

RATE = 20_000.0
TIME = np.arange(0.0, 2.0, 1.0 / RATE)
# From 10 to 40 turns per second; the vibration has orders 30 and 60, and one halfway between.
ANGLE = 2 * np.pi * (10.0 * TIME + 7.5 * TIME**2)
TEETH = Teeth(30, 20, 70)
ORDERS = {30.0: 1.0, 60.0: 0.4, 45.5: 0.1}


def vibration(angle):
    return sum(a * np.sin(order * angle + order) for order, a in ORDERS.items())


def share_within(axis, amplitude, low, high):
    power = amplitude[1:] ** 2
    inside = (axis[1:] > low) & (axis[1:] < high)
    return power[inside].sum() / power.sum()


@pytest.mark.parametrize("sense", [1.0, -1.0])
def test_a_run_up_has_sharp_orders_and_a_smeared_plain_spectrum(sense):
    signal = vibration(ANGLE)
    orders = pt.order_spectrum(signal, sense * ANGLE, 256)
    lines = pt.strongest_lines(*orders, count=3)
    assert [line.place for line in lines] == pytest.approx([30.0, 60.0, 45.5], abs=2e-3)
    assert [line.amplitude for line in lines] == pytest.approx([1.0, 0.4, 0.1], rel=5e-3)
    near = sum(share_within(*orders, order - 0.1, order + 0.1) for order in ORDERS)
    assert near > 0.9999
    plain = pt.amplitude_spectrum(signal, RATE)
    assert plain.amplitude.max() < 0.1
    # Order 30 alone sweeps 300 to 1200 Hz; the widest of its share in 3 Hz holds next to nothing.
    assert max(share_within(*plain, f, f + 3.0) for f in np.arange(300.0, 1200.0, 3.0)) < 0.03


def test_the_map_keeps_each_order_in_place_while_the_speed_rises():
    found = pt.order_map(vibration(ANGLE), TIME, ANGLE, turns=4.0, samples_per_turn=256)
    assert np.all(np.diff(found.time) > 0)
    rate = found.speed / (2 * np.pi)
    assert rate == pytest.approx(10.0 + 15.0 * found.time, rel=0.01)
    assert np.all(found.order[found.amplitude.argmax(axis=1)] == 30.0)
    assert found.amplitude[:, found.order == 30.0] == pytest.approx(1.0, rel=0.01)
    assert found.amplitude[:, found.order == 60.0] == pytest.approx(0.4, rel=0.01)


def test_the_map_has_the_windows_asked_for_and_both_ends():
    found = pt.order_map(vibration(ANGLE), TIME, ANGLE, turns=2.0, most_windows=7)
    assert found.amplitude.shape == (7, len(found.order))
    assert found.time[0] < 0.15
    assert found.time[-1] > 1.9


def test_resampling_follows_the_signal_between_its_samples():
    """A tone at an eighth of the sample rate at the highest speed."""
    order = RATE / 8 / 40
    found = pt.resample_by_angle(np.sin(order * ANGLE), ANGLE, 500)
    assert np.allclose(np.diff(found.angle), 2 * np.pi / 500)
    inner = slice(20, -20)
    assert np.abs(found.samples - np.sin(order * found.angle))[inner].max() < 2e-3


@pytest.mark.parametrize("share", [0.25, 0.4, 0.469])
@pytest.mark.parametrize("acceleration", [0.0, 15.0])
def test_an_order_line_is_exact_up_to_the_end_of_its_band(share, acceleration):
    angle = 2.0 * np.pi * (10.0 * TIME + 0.5 * acceleration * TIME**2)
    order = share * RATE / (10.0 + acceleration * TIME[-1])
    signal = Signal(0.5 * np.sin(order * angle + 0.3), TIME, angle, None)
    (line,) = order_spectrum_of(signal, None).lines(1)
    assert line.place == pytest.approx(order, rel=1e-4)
    assert line.amplitude == pytest.approx(0.5, rel=0.01)


def test_what_is_beyond_half_samples_per_turn_does_not_fold_back():
    signal = np.sin(60 * ANGLE)
    for samples_per_turn, kept in ((150, 1.0), (100, 0.0)):
        amplitude = pt.order_spectrum(signal, ANGLE, samples_per_turn, "flattop").amplitude
        assert amplitude.max() == pytest.approx(kept, abs=0.01)


def test_orders_of_the_meshing_follow_from_the_teeth():
    assert pt.mesh_order(TEETH, "carrier", "sun") == 30
    assert pt.mesh_order(TEETH, "carrier", "ring") == 70
    assert pt.mesh_order(TEETH, "carrier", "planet") == 20
    assert pt.mesh_order(TEETH, "ring", "carrier") == 70
    assert pt.mesh_order(TEETH, "ring", "sun") == 21
    assert pt.mesh_order(TEETH, "sun", "carrier") == 30
    assert pt.mesh_order(TEETH, "ring", "planet") == Fraction(70 * 20, 50)
    with pytest.raises(ValueError, match="two of"):
        pt.mesh_order(TEETH, "carrier", "carrier")


def test_simulated_run_has_its_lines_at_orders_of_its_meshing():
    scene = pt.load_scene("paper").replace(input_speed=pt.rpm(1000))
    result = pt.simulate(scene, duration=0.3, sample_rate=20_000)
    sun = result.angle[:, result.bodies.index("sun")]
    steady = TIME[: len(sun)] > 0.1
    orders = pt.order_spectrum(result.dte[steady, 0], sun[steady])
    mesh = float(pt.mesh_order(TEETH, scene.gearset.held, "sun"))
    assert orders.order[1 + orders.amplitude[1:].argmax()] == pytest.approx(mesh, abs=0.2)


BACK = np.concatenate((ANGLE[:500], ANGLE[499::-1]))


@pytest.mark.parametrize(
    ("call", "reason"),
    [
        (lambda: pt.order_spectrum(TIME, ANGLE[1:]), "angle: 39999 values for 40000 samples"),
        (lambda: pt.order_spectrum(BACK, BACK), "reverses or stands still after sample"),
        (lambda: pt.order_spectrum(TIME, np.append(ANGLE[1:], np.nan)), "angle: not finite at"),
        (lambda: pt.order_spectrum(TIME, ANGLE, 2), "samples_per_turn = 2"),
        (lambda: pt.order_spectrum(TIME, TIME**4 + 1e-9 * TIME), "exclude standstill"),
        (lambda: pt.order_map(TIME, TIME, ANGLE, turns=99.0), "turns = 99"),
        (lambda: pt.order_map(np.ones((40000, 2)), TIME, ANGLE), "must be one channel"),
    ],
)
def test_misuse_ends_in_one_line_that_names_it(call, reason):
    with pytest.raises(ValueError, match=reason) as caught:
        call()
    assert "\n" not in str(caught.value)
