"""What the compiled mesh takes for its stiffness, against the laws it is built from."""

import numpy as np
import pytest
from planetary_twin_core_parts import find_segment, mesh_stiffness
from tiers import first

import planetary_twin_py as pt
from planetary_twin_py.model.gearbox import Gearbox
from planetary_twin_py.model.stiffness_laws import tooth_pairs

PAPER = pt.load_scene("paper")
INVOLUTE = PAPER.replace(**{"mesh.stiffness": "involute"})
KINDS = pytest.mark.parametrize("kind", [0, 1], ids=["sun_planet", "planet_ring"])


def over_the_cycle(scene, kind, cycles):
    train = Gearbox(scene).train
    mesh = kind * train.meshes // 2
    return np.array(
        [mesh_stiffness(train, mesh, find_segment(train, kind, x, 1.0), x) for x in cycles]
    )


def positions(pair, x, margin):
    """Positions of the pairs that are wholly in contact at the cycle fraction x."""
    candidates = x + np.arange(-2, 3)
    path = pair.path
    return candidates[(candidates > margin - path.approach) & (candidates < path.recess - margin)]


@pytest.mark.parametrize("kind", first(1, [0, 1]), ids=["sun_planet", "planet_ring"])
def test_two_pairs_share_their_gear_bodies(kind):
    pair, ramp = tooth_pairs(INVOLUTE)[kind], INVOLUTE.mesh.ramp
    width = INVOLUTE.gearset.face_width
    cycles = np.linspace(0.0, 1.0, 400, endpoint=False)
    checked = {1: 0, 2: 0}
    for x, k in zip(cycles, over_the_cycle(INVOLUTE, kind, cycles), strict=True):
        inside, touching = positions(pair, x, ramp), positions(pair, x, 0.0)
        if len(inside) != len(touching):
            continue  # one is on its ramp
        checked[len(inside)] += 1
        if len(inside) == 1:
            assert k == pytest.approx(pair.stiffness(inside, width)[0], rel=1e-5)
        else:
            coupled = pair.double_contact_stiffness(inside[:1], width)[0]
            assert k == pytest.approx(coupled, rel=0.03)
    assert min(checked.values()) > 10


@KINDS
def test_given_stiffness_is_that_of_one_and_two_pairs(kind):
    cycles = np.linspace(0.0, 1.0, 200, endpoint=False)
    found = over_the_cycle(PAPER, kind, cycles)
    assert (found.min(), found.max()) == pytest.approx((2e8, 3.5e8))
    constant = over_the_cycle(PAPER.replace(**{"mesh.double_pair_ratio": 1.0}), kind, cycles)
    assert constant == pytest.approx(2e8)


def test_the_nominal_load_stiffens_the_contact_by_little():
    light = Gearbox(INVOLUTE.replace(input_torque=6.3)).train.teeth.stiffness
    heavy = Gearbox(INVOLUTE).train.teeth.stiffness
    assert np.all((heavy > 1.02 * light) & (heavy < 1.2 * light))


def test_a_deep_crack_softens_more_and_bends_at_the_tip():
    dte = {}
    for depth in (None, "0.3 mm", "0.6 mm"):
        faults = [{"kind": "crack", "gear": "sun", "tooth": 1, "depth": depth}] if depth else []
        calm = {"lubrication.friction": False, "mesh.damping.law": "viscous"}
        scene = INVOLUTE.replace(faults=faults, input_speed=10.0, **calm)
        dte[depth] = pt.simulate(scene, 0.04, tolerance=1e-5).dte[:, 0]
    grown = [np.max(dte[depth] - dte[None]) for depth in ("0.3 mm", "0.6 mm")]
    assert 0.0 < grown[0] < 0.6 * grown[1]
