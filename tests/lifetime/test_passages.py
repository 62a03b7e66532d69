"""Passages of teeth against printed numbers of a wind turbine."""

import pytest

import planetary_twin_py as pt
from planetary_twin_py.lifetime.passages import passages_per_turn

SCENE = pt.load_scene("reference_gearbox_stage").replace(durability={})


def test_passages_in_an_hour_are_the_printed_ones():
    """KISSsoft 03/2017 of the NREL 5 MW gearbox: 1124.7, 419.0 and 381.6 e6 in 175 200 h."""
    per_hour = {part: 12.1 * 60.0 * float(n) for part, (n, _) in passages_per_turn(SCENE).items()}
    assert per_hour["sun_flank_drive"] + per_hour["sun_flank_coast"] == pytest.approx(
        1124.7e6 / 175_200, rel=1e-4
    )
    assert per_hour["planet_1_flank_sun"] == pytest.approx(419.0e6 / 175_200, rel=1e-4)
    assert per_hour["planet_1_root"] == 2.0 * per_hour["planet_1_flank_ring"]
    assert per_hour["ring_flank_drive"] + per_hour["ring_flank_coast"] == pytest.approx(
        2178.0, rel=1e-4
    )


def test_one_sense_of_torque_loads_one_flank():
    for part, (drive, coast) in passages_per_turn(SCENE).items():
        if part.endswith(("_drive", "_coast")):
            assert (drive == 0) != (coast == 0)
