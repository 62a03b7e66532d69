"""Bearings of planets against the centrifugal force on a turning carrier."""

import math

import pytest

import planetary_twin_py as pt

FLOATING = pt.load_scene("floating_sun")
MASS = 100.0  # [kg] of a planet


def turning(dynamics: str, speed: float, stiffness: float) -> pt.Scene:
    """The ring is held, the carrier turns at `speed` [rad/s]."""
    return FLOATING.replace(
        dynamics=dynamics,
        input_speed=speed,
        **{
            "gearset.held": "ring",
            "drive.input.member": "carrier",
            "drive.output.member": "sun",
            "supports.planet.mass": MASS,
            "supports.planet.bearing": stiffness,
        },
    )


@pytest.mark.parametrize("dynamics", ["planar", "quasi_static_planar"])
def test_bearing_that_the_centrifugal_force_overcomes_is_refused(dynamics):
    speed = -300.0
    least = MASS * speed**2
    with pytest.raises(pt.SceneError, match=r"^supports\.planet\.bearing = .* must be above"):
        pt.Twin(turning(dynamics, speed, 0.999 * least))


@pytest.mark.parametrize("dynamics", ["planar", "quasi_static_planar"])
def test_a_speed_without_equilibrium_is_refused_by_a_twin(dynamics):
    stiffness = 5e7
    twin = pt.Twin(turning(dynamics, 20.0, stiffness))
    twin.advance(0.001)
    too_fast = 1.001 * math.sqrt(stiffness / MASS)
    with pytest.raises(pt.SceneError, match=r"^supports\.planet\.bearing"):
        twin.set(input_speed=too_fast)
    twin.advance(0.001)
    assert twin.time == pytest.approx(0.002)
    assert twin.scene.operating_point.input_speed == 20.0


def test_a_carrier_that_is_held_softens_no_bearing():
    assert FLOATING.gearset.held == "carrier"
    speed = 500.0
    given = {"supports.planet.mass": MASS, "supports.planet.bearing": 0.5 * MASS * speed**2}
    pt.Twin(FLOATING.replace(input_speed=speed, **given)).advance(0.001)
