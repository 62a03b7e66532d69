"""Costs are measured on scenes that differ in what the table names, and in nothing else."""

import math

import pytest
from planetary_twin_benchmark import costs

from planetary_twin_py.gearset.phasing import mesh_phases
from planetary_twin_py.run.engine import Engine
from planetary_twin_py.run.start import start
from planetary_twin_py.scene import load_scene


@pytest.mark.parametrize("count", costs.PLANETS)
def test_planets_mesh_in_phase_and_out_of_phase(count):
    phases = checked_phases(count, costs.TEETH)
    assert len({phase % 1 for phase in phases}) == count


@pytest.mark.parametrize("count", costs.PLANETS)
def test_planets_in_phase_differ_only_in_teeth(count):
    teeth = costs.teeth_in_phase(count)
    assert {phase % 1 for phase in checked_phases(count, teeth)} == {0}
    assert max(abs(a - b) for a, b in zip(teeth, costs.TEETH, strict=True)) <= 2 * count
    assert Engine(scene_of(count, teeth), 1e-3).train.meshes == 2


@pytest.mark.parametrize("case", costs.PLANET_CASES, ids=lambda case: case.name)
def test_every_unequal_planet_is_integrated(case):
    scene = case.scene()
    entries = 2 if scene.moving_axes else 1  # of a mesh
    assert start(scene, 1e-3).train.meshes == scene.gearset.planets * 2 * entries


def scene_of(count, teeth):
    return load_scene("paper").replace(**costs.planets(count, teeth))


def checked_phases(count, teeth):
    scene, paper = scene_of(count, teeth), load_scene("paper")
    assert scene.gearset.planets == count
    turn = scene.operating_point.input_speed / (2.0 * math.pi)
    assert turn * scene.gearset.teeth.sun == pytest.approx(costs.MESH_FREQUENCY)
    load = paper.operating_point.input_torque / paper.gearset.planets
    assert scene.operating_point.input_torque / count == pytest.approx(load)
    return mesh_phases(scene.gearset.tooth_numbers, scene.gearset.planet_angles)[0]
