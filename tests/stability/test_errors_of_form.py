"""Errors of form far beyond what the load bends, up to teeth that cannot pass."""

import pytest
from stability.sound import PAPER, sound_run, static_force, stiffnesses


def with_error(amplitude):
    return PAPER.replace(**{"mesh.sun_planet_error": {"amplitudes": [amplitude]}})


@pytest.mark.parametrize("amplitude", [1e-12, 5e-6, 5e-5])
def test_teeth_that_jam_and_part_with_every_error_keep_the_books(amplitude):
    """Fifty micrometres at 2e8 N/m: forces of 10 kN where the torque asks for 1.9."""
    run = sound_run(with_error(amplitude), 0.02)
    bent = static_force(PAPER) / stiffnesses(PAPER).min()
    assert (run.mesh_force == 0.0).any() == (amplitude > bent)
