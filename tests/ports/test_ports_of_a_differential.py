"""Ports of a differential, whose second motor holds its speed."""

import numpy as np
import pytest
from ports.ports_of_paper import driven

import planetary_twin_py as pt

DIFFERENTIAL = pt.load_scene("differential")
TEETH = DIFFERENTIAL.gearset.teeth


def test_the_input_follows_from_the_output_and_the_second_motor():
    """The motion of the output changes; the second motor still holds the carrier."""
    twin = pt.Twin(driven("torque", "motion", DIFFERENTIAL, **{"lubrication.friction": False}))
    begin = twin.port_states.output_speed
    for share in np.linspace(0.0, 1.0, 301)[1:]:
        shown = twin.step(1e-3, output_speed=begin + 5.0 * share)
    for _ in range(2000):  # several periods of the speed loop
        twin.step(1e-3)
    window = twin.advance(0.2)
    carrier = pt.rpm(-500)
    sun = ((TEETH.sun + TEETH.ring) * carrier - TEETH.ring * (begin + 5.0)) / TEETH.sun
    speeds = dict(zip(twin.bodies, window.mean_speed, strict=True))
    assert speeds["ring"] == pytest.approx(begin + 5.0, rel=1e-5)
    assert speeds["carrier"] == pytest.approx(carrier, rel=1e-3)
    assert speeds["sun"] == pytest.approx(sun, rel=1e-3)
    # Torques are as the numbers of teeth: Ts : Tr = Zs : Zr.
    torque = shown.input_torque * TEETH.ring / TEETH.sun
    assert window.output_torque == pytest.approx(torque, rel=1e-3)


def test_ports_that_a_differential_cannot_have_are_refused():
    with pytest.raises(ValueError, match=r"input.port = 'torque': requires drive.output.port = to"):
        driven("torque", "machine", DIFFERENTIAL)
    with pytest.raises(ValueError, match=r"drive.second_input.port = 'motion': must be machine"):
        DIFFERENTIAL.replace(**{"drive.second_input.port": "motion"})
