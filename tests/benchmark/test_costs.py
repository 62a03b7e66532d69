"""Costs are measured on scenes that differ in what the table names, and in nothing else."""

import math

import pytest
from planetary_twin_benchmark import costs

from planetary_twin_py.gearset.phasing import mesh_phases
from planetary_twin_py.run.engine import Engine
from planetary_twin_py.scene import load_scene


@pytest.mark.parametrize("count", costs.PLANETS)
def test_planets_mesh_alike_and_out_of_step(count):
    phases = checked_phases(count, costs.TEETH)
    assert len({phase % 1 for phase in phases}) == count


@pytest.mark.parametrize("count", costs.PLANETS)
def test_planets_in_phase_differ_only_in_teeth(count):
    teeth = costs.teeth_in_phase(count)
    assert {phase % 1 for phase in checked_phases(count, teeth)} == {0}
    assert max(abs(a - b) for a, b in zip(teeth, costs.TEETH, strict=True)) <= 2 * count
    assert Engine(costs.with_planets(count, teeth), 1e-3).train.meshes == 2


def checked_phases(count, teeth):
    scene, paper = costs.with_planets(count, teeth), load_scene("paper")
    assert scene.gearset.planets == count
    turn = scene.operating_point.input_speed / (2.0 * math.pi)
    assert turn * scene.gearset.teeth.sun == pytest.approx(costs.MESH_FREQUENCY)
    load = paper.operating_point.input_torque / paper.gearset.planets
    assert scene.operating_point.input_torque / count == pytest.approx(load)
    return mesh_phases(scene.gearset.tooth_numbers, scene.gearset.planet_angles)[0]
