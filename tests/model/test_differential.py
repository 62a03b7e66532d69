"""Two inputs: speeds add up, torques are as the teeth, and a set that turns as a block is still."""

import math

import numpy as np
import pytest

import planetary_twin_py as pt

SCENE = pt.load_scene("differential")


@pytest.mark.parametrize("second", [-500.0, 0.0, 500.0, 999.0])
def test_ring_turns_as_willis_says(second):
    run = pt.simulate(SCENE.replace(second_input_speed=pt.rpm(second)), 0.1)
    mean = run.speed[run.time > 0.05].mean(axis=0)
    sun, ring, carrier = mean[0], mean[-2], mean[-1]
    assert sun == pytest.approx(pt.rpm(1000.0), rel=0.01)
    assert carrier == pytest.approx(pt.rpm(second), rel=0.01, abs=0.5)
    assert 30 * (sun - carrier) == pytest.approx(-70 * (ring - carrier), rel=2e-3, abs=0.5)


def test_torques_have_the_ratio_of_the_teeth_except_for_losses():
    twin = pt.Twin(SCENE)
    twin.advance(0.2)
    window = twin.advance(0.2)
    sun, ring, carrier = window.machine_torque
    assert sun == pytest.approx(63.0, rel=2e-3)
    assert sun + ring + carrier == pytest.approx(0.0, abs=0.02 * 210)
    assert (ring, carrier) == pytest.approx((147.0, -210.0), rel=0.02)
    assert window.second_input_torque == carrier
    assert window.input_power == pytest.approx(
        window.output_power + window.power_loss + window.stored_power, rel=2e-3
    )


def test_a_second_input_at_rest_is_a_member_held():
    """But for a carrier that yields on its shaft, which is stiff here."""
    stiff = SCENE.replace(
        second_input_speed=0.0,
        **{"drive.second_input.coupling_stiffness": 1e9, "drive.second_input.inertia": 1e4},
    )
    held = pt.load_scene("paper")
    one, other = pt.simulate(stiff, 0.05), pt.simulate(held, 0.05)
    assert one.mesh_force.mean(axis=0) == pytest.approx(other.mesh_force.mean(axis=0), rel=2e-3)
    assert one.efficiency == pytest.approx(other.efficiency, abs=1e-4)
    assert one.dte[-500:] == pytest.approx(other.dte[-500:], rel=0.05)


def test_both_speeds_can_change_at_one_instant():
    twin = pt.Twin(SCENE)
    twin.advance(0.05)
    twin.set(input_speed=pt.rpm(800.0), second_input_speed=pt.rpm(200.0))
    for _ in range(60):
        window = twin.advance(0.02)
    assert window.input_speed == pytest.approx(pt.rpm(800.0), rel=5e-3)
    assert window.second_input_speed == pytest.approx(pt.rpm(200.0), rel=2e-2)
    assert np.isfinite(window.efficiency)


def test_angles_stay_exact_through_many_turns_of_both_motors():
    twin = pt.Twin(SCENE)
    for end in (twin._engine.integrator.end, twin._engine.integrator.begin):
        end.turns[:] = 123_456_789_000.0, 987_654_321_001.0
    twin.advance(1e-3)
    angle = dict(zip(twin.bodies, twin.advance(1e-6).angle, strict=True))
    # Sun and carrier turned whole turns; the ring by -3/7 and 10/7 of them.
    turns = (-3 * 123_456_789_000 + 10 * 987_654_321_001) % 7 / 7
    fresh = pt.Twin(SCENE)
    fresh.advance(1e-3)
    start = dict(zip(fresh.bodies, fresh.advance(1e-6).angle, strict=True))
    moved = (angle["ring"] - start["ring"]) / (2 * math.pi) - turns
    assert moved - round(moved) == pytest.approx(0.0, abs=1e-6)
