"""Peaks of passages lie between the nodes of long steps: loose tolerances find them as well."""

import numpy as np
import pytest
from lifetime.stages import stage

import planetary_twin_py as pt
from planetary_twin_py.model.gearbox import Gearbox
from planetary_twin_py.model.pair_loads import pair_loads

SCENES = ["paper", "paper_printed", "cracked_tooth", "reference_gearbox_stage", "e_axle"]


def load(name):
    if name in pt.packaged_scenes():
        return pt.load_scene(name).replace(durability={})
    return stage(name)


def run(scene, tolerance, rate=1.0, cycles=30):
    frequency = Gearbox(scene).mesh_frequency
    return pt.simulate(scene, cycles / frequency, rate * frequency, "march", tolerance, 0.05)


def of_passages(damage):
    """Damage of a passage of each flank that does at least a thousandth of the largest."""
    each = damage.damage / np.maximum(damage.passages, 1)
    flanks = np.array(["_flank_" in part for part in damage.parts])
    return np.where(flanks & (each > 1e-3 * each[flanks].max()), each, 0.0)


@pytest.mark.parametrize("name", SCENES)
def test_damage_at_loose_tolerances_is_the_converged_one(name):
    scene = load(name)
    converged = of_passages(run(scene, 1e-8).damage)
    counts = converged > 0.0
    for tolerance in (3e-3, 1e-3, 1e-4):
        found = of_passages(run(scene, tolerance).damage)
        assert found[counts] == pytest.approx(converged[counts], rel=0.02)


@pytest.mark.parametrize("name", ["paper_printed", "e_axle"])
def test_peaks_are_those_of_loads_at_close_samples(name):
    # an independent way: forces at 4000 samples of a mesh cycle, shared among the pairs afterwards
    scene = load(name)
    result = run(scene, 1e-3, rate=4000.0, cycles=6)
    box, geometry = Gearbox(scene), scene.gearset.geometry.meshes
    angle = {body: result.angle[:, n] for n, body in enumerate(result.bodies)}
    data = scene.lubrication
    modulus = data.youngs_modulus / (2.0 * (1.0 - data.poisson_ratio**2))
    factor = scene.durability.face_load_factor * modulus / (np.pi * scene.gearset.face_width)
    for mesh, found in enumerate(result.damage.peaks["contact_stress"]):
        pairs = pair_loads(box, mesh, angle, result.mesh_force[:, mesh])
        of_mesh = geometry[mesh // scene.gearset.planets]
        along = pairs.position * of_mesh.base_pitch
        first, second = of_mesh.curvatures
        sense = -1.0 if of_mesh.internal else 1.0
        rho1, rho2 = first + along, second - sense * along
        square = factor * pairs.load * (rho2 + sense * rho1) / (rho1 * rho2)
        assert found == pytest.approx(np.sqrt(square[pairs.load > 0.0].max()), rel=2e-3)
