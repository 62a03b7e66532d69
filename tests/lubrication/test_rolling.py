"""Rolling resistance against the formula by hand, and what it takes from a running set."""

import math

import pytest
from planetary_twin_core_parts import rolling_resistance

import planetary_twin_py as pt

ROLLING = {"lubrication.rolling": "goksem_hargreaves"}


def test_force_at_the_pitch_point():
    """U 9.26e-11, G 4754, W 2.376e-4, R L/alpha 1664 N: 0.427 N on each flank."""
    modulus, radius, length, alpha = 226.37e9, 1.747e-3, 0.02, 2.1e-8
    groups = (
        0.08 * 0.4573 / (modulus * radius),
        alpha * modulus,
        1878.8 / (modulus * radius * length),
    )
    force = rolling_resistance(radius * length / alpha, *map(math.log, groups))
    assert force == pytest.approx(0.427, abs=0.003)
    once, twice = (
        rolling_resistance(1.0, *map(math.log, (speed, 5e3, 1e-4))) for speed in (1e-11, 2e-11)
    )
    assert twice / once == pytest.approx(2**0.658)


@pytest.mark.parametrize("speed", [1000.0, -1000.0])
def test_rolling_takes_power_in_both_directions(speed):
    scene = pt.load_scene("paper").replace(
        input_speed=pt.rpm(speed), input_torque=math.copysign(63.0, speed)
    )
    without = pt.simulate(scene, 0.05, tolerance=1e-5)
    with_ = pt.simulate(scene.replace(**ROLLING), 0.05, tolerance=1e-5)
    more = with_.energy.friction - without.energy.friction
    # Six meshes of 1.5 pairs, some 0.4 N on both flanks at 0.46 m/s each.
    assert 6 * 1.2 * 0.3 * 0.9 * 0.05 < more < 6 * 2.0 * 0.9 * 1.0 * 0.05
    assert with_.total_power_loss.mean() == pytest.approx(with_.energy.friction / 0.05, rel=5e-3)
    assert abs(with_.energy.residual) < 1e-6 * with_.energy.driving_work


def test_resistance_vanishes_with_the_load():
    """In cold oil it would exceed a light mesh force, part the flanks, and vanish with them."""
    scene = pt.load_scene("paper").replace(
        **ROLLING,
        **{
            "oil_temperature": 253.0,
            "input_torque": 0.3,
            "input_speed": 50.0,
            "mesh.damping.law": "printed_meshing_frequency",
            "mesh.sun_planet_error": {"amplitudes": ["2 um", "0.5 um"]},
        },
    )
    run = pt.simulate(scene, 0.02, tolerance=1e-5)
    assert 0 < run.stats.flank_events < 1000  # some 10 to a mesh and mesh cycle
    assert abs(run.energy.residual) < 1e-4 * sum(abs(work) for work in run.energy.machines)
