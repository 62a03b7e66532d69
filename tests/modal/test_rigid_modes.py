"""Rigid modes follow from the structure: a real mode is kept however low its frequency is."""

import math

import numpy as np
import pytest
from power_flows import DIFFERENTIALS, FLOWS, scene_of

import planetary_twin_py as pt
from planetary_twin_py.modal.modes import modes_of
from planetary_twin_py.modal.natural import spring_model

BODIES = ("sun", "planet", "ring", "carrier")
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


def inertia_at_the_sun(scene):
    """J of the whole train with its ring held, in turns of the sun (Willis) [kg m^2]."""
    gearset, mass = scene.gearset, scene.gearset.equivalent_mass
    teeth, module = gearset.teeth, gearset.module
    carrier = teeth.sun / (teeth.sun + teeth.ring)
    planet = carrier - (1 - carrier) * teeth.sun / teeth.planet
    sun_radius, planet_radius = module * teeth.sun / 2, module * teeth.planet / 2
    centres = sun_radius + planet_radius
    carried = mass.carrier + gearset.planets * scene.supports.planet.mass
    return (
        mass.sun * sun_radius**2
        + carried * (centres * carrier) ** 2
        + gearset.planets * mass.planet * (planet_radius * planet) ** 2
    )


@pytest.mark.parametrize("model", ["planar", "spatial"])
def test_a_soft_support_leaves_a_mode_of_turning(model):
    firm = {f"supports.{body}.{way}": 1e9 for body in BODIES for way in ("axial", "tilting")}
    scene, torsion = pt.load_scene("wind_turbine_stage").replace(**firm), 1e-3
    assert scene.gearset.held == "ring"
    free = pt.natural_modes(scene, model)
    modes = pt.natural_modes(scene.replace(**{"supports.sun.torsion": torsion}), model)
    gearset = scene.gearset
    base_radius = gearset.module * gearset.teeth.sun / 2 * math.cos(gearset.pressure_angle)
    stiffness = torsion * base_radius**2
    expected = math.sqrt(stiffness / inertia_at_the_sun(scene)) / (2 * math.pi)
    assert expected < SOFT * modes.frequencies[-1]
    rigid = modes.kinds.count("rigid")
    assert rigid == free.kinds.count("rigid") - 1
    assert np.all(modes.frequencies[:rigid] == 0.0)
    assert modes.kinds[rigid] == "rotational"
    assert modes.frequencies[rigid] == pytest.approx(expected, rel=1e-6)


@pytest.mark.parametrize("model", ["torsional", "machines"])
@pytest.mark.parametrize("flow", [FLOWS[0], FLOWS[2], FLOWS[4], DIFFERENTIALS[0]], ids=str)
def test_there_are_as_many_rigid_modes_as_independent_speeds(flow, model):
    """A held member leaves one speed free, a differential two (Willis)."""
    modes = pt.natural_modes(scene_of(flow), model)
    assert modes.kinds.count("rigid") == (2 if flow in DIFFERENTIALS else 1)


def test_rigid_modes_do_not_depend_on_how_stiff_the_springs_are():
    model = spring_model(pt.load_scene("wind_turbine_stage"), "planar")
    rigid = modes_of(model).kinds.count("rigid")
    for share in (1e-12, 1e12):
        springs = tuple(
            spring._replace(stiffness=spring.stiffness * (share if k % 2 else 1.0))
            for k, spring in enumerate(model.springs)
        )
        assert modes_of(model._replace(springs=springs)).kinds.count("rigid") == rigid
