"""Impacts that follow one another ever faster must not hold up time."""

import numpy as np
import pytest
from stability.sound import PAPER, assert_closed, assert_finite
from tiers import first

import planetary_twin_py as pt

SPAN = 0.02  # [s]
# Two pairs in contact, 1.75 times as stiff as one.
FASTEST = max(pt.natural_modes(PAPER).frequencies) * np.sqrt(PAPER.mesh.double_pair_ratio)
LOADS = {
    "idle": (0.0, 0.0),
    "ripple alone": (0.0, 1.0),
    "just touching": (1.0, 1.0),
    "just parting": (1.0, 1.001),
    "next to nothing": (1e-6, 1e-3),
}


def chatters(load, **changes):
    """A run that passes all its impacts at a bounded cost.

    A mesh swings no faster than the fastest mode, passes its play twice a period, and parts and
    meets each time: four events a period.
    """
    torque, ripple = LOADS[load]
    scene = PAPER.replace(input_torque=torque, torque_ripple=ripple, **changes)
    run = pt.simulate(scene, SPAN, 20_000.0, tolerance=1e-5)
    assert_finite(run)
    assert_closed(run, scene, share=1e-3)
    stats = run.stats
    assert stats.flank_events < 4.0 * len(run.meshes) * FASTEST * SPAN
    causes = FASTEST * SPAN + stats.flank_events + stats.pair_events
    assert stats.steps < 40.0 * causes
    return stats


@pytest.mark.parametrize("load", LOADS)
@pytest.mark.parametrize("backlash", [0.0, 2e-7, 1e-5])
@pytest.mark.parametrize("damping", [0.0, 2.0])
def test_impacts_are_no_more_than_the_modes_can_make(load, backlash, damping):
    chatters(
        load,
        backlash=backlash,
        **{"mesh.damping.law": "viscous", "mesh.damping.damping_ratio": damping},
    )


@pytest.mark.parametrize("load", LOADS)
@pytest.mark.parametrize("law", ["meshing_frequency", "printed_meshing_frequency"])
def test_the_same_with_friction_that_acts_where_flanks_touch(load, law):
    chatters(
        load,
        **{
            "mesh.damping.law": law,
            "lubrication.rolling": "goksem_hargreaves",
            "lubrication.boundary": "load_sharing",
        },
    )


@pytest.mark.xfail(strict=True, reason="flanks chatter ever faster at the jump of the printed law")
@pytest.mark.parametrize("torque", [0.3, pytest.param(1.0, marks=pytest.mark.exhaustive)])
@pytest.mark.parametrize("speed", first(1, [0.0, 104.72]))
def test_a_light_load_rests_at_the_jump_of_the_printed_force_law(torque, speed):
    """F jumps by k B where flanks meet: what is lighter than that jump has no place to rest."""
    scene = PAPER.replace(
        input_torque=torque, input_speed=speed, **{"mesh.backlash": "regulatory_factor"}
    )
    span = 2e-3
    run = pt.simulate(scene, span, 20_000.0, tolerance=1e-4)
    assert run.stats.flank_events < 4.0 * len(run.meshes) * FASTEST * span


@pytest.mark.parametrize("order", [1, 20, 100])
def test_the_same_under_a_ripple_as_fast_as_it_may_be(order):
    chatters("ripple alone", **{"drive.speed_control.ripple_order": order})


@pytest.mark.parametrize("speed", [-1e-3, 0.0, 1.0])
def test_flanks_at_rest_without_load_do_not_chatter(speed):
    stats = chatters("idle", input_speed=speed)
    assert stats.flank_events < 60
    assert stats.steps < 1000
