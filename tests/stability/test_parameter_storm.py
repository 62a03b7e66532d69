"""Hundreds of changes of everything, one after another."""

import numpy as np
import pytest
from stability.sound import PAPER, PLAIN
from tiers import first

import planetary_twin_py as pt

CHANGES = 300
CALM = {
    "backlash": (0.0, 1e-5),
    "lambda_ratio": (0.0, 5.0),
    "oil_temperature": (300.0, 400.0),
    "input_speed": (-200.0, 200.0),
    "input_torque": (-100.0, 100.0),
    "torque_ripple": (0.0, 10.0),
}
WILD = {name: (t.minimum, t.maximum) for name, t in PAPER.tunables.items()}
del WILD["second_input_speed"]  # of a differential
WINDOWS = [1.7e-9, 1e-4, 1e-3]


def storm(random, ranges):
    """Each time some of the fields, anywhere within their ranges or at an end of them."""
    for _ in range(CHANGES):
        names = [name for name in ranges if random.random() < 0.5]
        yield {
            name: float(random.choice([*ranges[name], random.uniform(*ranges[name])]))
            for name in names
        }


def assert_sound(window):
    wave = window.waveform
    for values in (wave.dte, wave.mesh_force, wave.friction, window.angle, window.mean_speed):
        assert np.isfinite(values).all()
    assert np.isfinite(window.power_loss) and window.power_loss > -1e-9  # rounding


@pytest.mark.parametrize("ranges", [CALM, WILD], ids=["calm", "wild"])
@pytest.mark.parametrize("length", first(2, WINDOWS))
def test_a_storm_of_changes_is_weathered(ranges, length):
    random, twin = np.random.default_rng(7), pt.Twin(PAPER)
    for change in storm(random, ranges):
        twin.set(**change)
        assert_sound(twin.advance(length * random.uniform(0.1, 1.0)))
    assert twin.operating_point == twin.log[-1].point
    assert all(a.time <= b.time for a, b in zip(twin.log, twin.log[1:], strict=False))


@pytest.mark.parametrize("damping", [0.0, 2.0])
def test_no_energy_comes_out_of_a_storm_that_did_not_go_in(damping):
    """One stiffness, so that all that is neither stored nor given back is damped."""
    scene = PLAIN.replace(**{"mesh.damping.damping_ratio": damping})
    random, twin = np.random.default_rng(11), pt.Twin(scene, tolerance=1e-5)
    for change in storm(random, CALM):
        twin.set(**change)
        window = twin.advance(random.uniform(1e-3, 3e-3))
        flows = (window.input_power, -window.output_power, -window.stored_power)
        assert sum(flows) >= -1e-4 * sum(map(abs, flows))


def test_after_a_storm_the_twin_runs_as_if_there_had_been_none():
    random, stormy, calm = np.random.default_rng(3), pt.Twin(PAPER), pt.Twin(PAPER)
    for change in storm(random, CALM):
        stormy.set(**change)
        stormy.advance(1e-4)
    stormy.set(**PAPER.operating_point.model_dump())
    for twin in (stormy, calm):
        for _ in range(4):
            twin.advance(0.5)
    one, two = (twin.advance(0.1) for twin in (stormy, calm))
    assert one.input_speed == pytest.approx(two.input_speed, rel=1e-4)
    assert one.power_loss == pytest.approx(two.power_loss, rel=1e-3)
    for name in ("dte_mean", "dte_rms", "mesh_force_mean"):
        assert one.mesh[name].mean() == pytest.approx(two.mesh[name].mean(), rel=1e-2)
