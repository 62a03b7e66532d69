"""Fields that a scene has but does not use."""

import numpy as np
import pytest

import planetary_twin_py as pt
from planetary_twin_py.scene.unused import without_effect

PAPER = pt.load_scene("paper")
SHARING = PAPER.replace(**{"lubrication.boundary": "load_sharing"})


def test_the_boundary_coefficient_is_unused_with_asperities():
    field = "lubrication.boundary_coefficient"
    (line,) = without_effect(PAPER, [field])
    assert "lubrication.boundary = greenwood_tripp does not use it" in line
    assert "set lubrication.boundary = load_sharing" in line
    coefficients = (0.05, 0.5)
    low, high = (pt.simulate(PAPER.replace(**{field: each}), 0.002) for each in coefficients)
    assert (low.power_loss == high.power_loss).all()
    low, high = (pt.simulate(SHARING.replace(**{field: each}), 0.002) for each in coefficients)
    assert (low.power_loss != high.power_loss).any()


RING = {"name": "ring", "kind": "accelerometer", "rate": 5e3}
SHAFT = {"name": "shaft", "kind": "encoder", "lines": 256, "rate": 5e3}


@pytest.mark.parametrize(
    ("sensor", "field", "value", "used", "words"),
    [
        (RING | {"noise": 0.0}, "seed", 3, {"noise": 0.1}, "the sensor has no noise"),
        (RING, "bits", 8, {"range": 50.0}, "set range"),
        (RING, "damping_ratio", 0.5, {"resonance": 1e3}, "set resonance"),
        (
            RING | {"path": {"law": "window", "shape": "exponential"}}, "path.power", 2,
            {"path": {"law": "window"}}, "set path.shape = cosine",
        ),
        (
            RING, "path.decay", 1.0, {"path": {"law": "window", "shape": "exponential"}},
            "set path.shape = exponential",
        ),
        (
            SHAFT, "phase", 1.0, {"eccentricity": 1e-4, "radius": 0.025},
            "the disc is on its axis",
        ),
        (SHAFT, "heads", 2, {"eccentricity": 1e-4, "radius": 0.025}, "the disc is on its axis"),
    ],
)  # fmt: skip
def test_a_field_of_a_sensor_is_unused_if_readings_are_the_same(sensor, field, value, used, words):
    """Readings of a run tell: the same with another value, and others where it has an effect."""
    name, scene = f"sensors.0.{field}", PAPER.replace(sensors=[sensor])
    (line,) = without_effect(scene, [name])
    assert line.startswith(f"{name}: has no effect: ") and words in line
    other = PAPER.replace(sensors=[sensor | used])
    assert not list(without_effect(other, [name]))

    def readings(of):
        return next(iter(pt.simulate(of, 0.02, 1e3).sensors.values())).values

    assert np.array_equal(readings(scene), readings(scene.replace(**{name: value})))
    assert not np.array_equal(readings(other), readings(other.replace(**{name: value})))
