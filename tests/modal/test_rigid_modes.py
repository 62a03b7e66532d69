"""Rigid modes follow from the structure: a real mode is kept however low its frequency is."""

import math

import pytest
from power_flows import DIFFERENTIALS, FLOWS, scene_of

import planetary_twin_py as pt

SOFT = 1e-7  # of the highest frequency: where the low modes of these tests are


def soft_drive(coupling):
    """The paper's gears between a motor and a load of great inertia on soft couplings [N m/rad]."""
    changes = {f"drive.{side}.inertia": 1e6 for side in ("input", "output")}
    changes |= {f"drive.{side}.coupling_stiffness": coupling for side in ("input", "output")}
    return pt.load_scene("paper").replace(**changes)


def test_a_soft_coupling_leaves_a_mode_of_motor_and_load():
    """Two inertias on two springs in series, the gears between them being without mass.

    In turns of the motor the load has J (Zs/Zr)^2 and its coupling k (Zs/Zr)^2.
    """
    stiffness, inertia, ratio = 0.2, 1e6, (30 / 70) ** 2
    modes = pt.natural_modes(soft_drive(stiffness), "machines")
    series = 1 / (1 / stiffness + 1 / (stiffness * ratio))
    expected = math.sqrt(series * (1 + 1 / ratio) / inertia) / (2 * math.pi)
    assert expected < SOFT * modes.frequencies[-1]
    assert modes.kinds.count("rigid") == 1 and modes.frequencies[0] == 0.0
    assert modes.kinds[1] == "rotational"
    assert modes.frequencies[1] == pytest.approx(expected, rel=1e-6)


@pytest.mark.parametrize("model", ["torsional", "machines"])
@pytest.mark.parametrize("flow", [FLOWS[0], FLOWS[2], FLOWS[4], DIFFERENTIALS[0]], ids=str)
def test_there_are_as_many_rigid_modes_as_independent_speeds(flow, model):
    """A held member leaves one speed free, a differential two (Willis)."""
    modes = pt.natural_modes(scene_of(flow), model)
    assert modes.kinds.count("rigid") == (2 if flow in DIFFERENTIALS else 1)
