"""Tip relief: loads and deflection of the table against a solution by bracketing, and Harris."""

import numpy as np
import pytest
from scipy.optimize import brentq
from tiers import first

import planetary_twin_py as pt
from planetary_twin_py._core import PAIRS, TERMS, TOTAL
from planetary_twin_py.gearset.geometry import PathOfContact
from planetary_twin_py.mesh.stiffness import given_stiffness
from planetary_twin_py.mesh.tip_relief import PairGap, Relief, relieved_table
from planetary_twin_py.mesh.tooth_pairs import pair_table
from planetary_twin_py.model.gearbox import Gearbox

PATH = PathOfContact(0.75, 0.85)
STIFFNESS, FORCE = 2e8, 2000.0


def in_table(table, cycle):
    """Weights of pairs and sum, and positions of the pairs, at a fraction of the cycle."""
    j = int(np.searchsorted(table.edge[1 : table.segments], cycle, side="right"))
    powers = (cycle - table.edge[j]) ** np.arange(TERMS)
    return table.weight[j] @ powers, cycle + table.shift[j], table.present[j]


def one_gap(relief, from_tip):
    share = min(max(1.0 - from_tip / relief.length, 0.0), 1.0)
    return relief.amount * share ** (1 if relief.shape == "linear" else 2)


def balanced(plain, law, gap, cycle):
    """Deflection and loads of pairs that carry FORCE, by bracketing the deflection."""
    weight, position, present = in_table(plain, cycle)
    total = weight[TOTAL]
    pairs = [
        (
            (law.base / total + law.gain) * weight[p],
            one_gap(gap.first, PATH.recess - position[p])
            + one_gap(gap.second, position[p] + PATH.approach),
        )
        for p in range(PAIRS)
        if present[p]
    ]

    def surplus(d):
        return sum(k * max(d - g, 0.0) for k, g in pairs) - FORCE

    found = brentq(surplus, 0.0, 1e-3, xtol=1e-18, rtol=1e-14)
    return found, [k * max(found - g, 0.0) for k, g in pairs]


@pytest.mark.parametrize("ratio", [1.6, 2.0])
@pytest.mark.parametrize("ramp", [0.0, 0.03])
@pytest.mark.parametrize("amounts", first(1, [(12e-6, 8e-6), (3e-6, 5e-6), (40e-6, 30e-6)]))
@pytest.mark.parametrize("shapes", [("linear", "linear"), ("parabolic", "linear")])
def test_deflection_and_loads_balance_the_force(ratio, ramp, amounts, shapes):
    law = given_stiffness(STIFFNESS, ratio)
    gap = PairGap(PATH, Relief(amounts[0], 0.4, shapes[0]), Relief(amounts[1], 0.3, shapes[1]))
    plain, table = pair_table(PATH, ramp), relieved_table(gap, ramp, law, FORCE)
    for cycle in np.linspace(0.0, 1.0, 997)[1:-1]:
        squeeze, loads = balanced(plain, law, gap, cycle)
        weight, _, present = in_table(table, cycle)
        stiffness = law.base + law.gain * weight[TOTAL]
        assert FORCE / stiffness == pytest.approx(squeeze, rel=2e-4)
        shares = weight[:PAIRS][present] / weight[TOTAL] * FORCE
        assert shares == pytest.approx(loads, abs=1e-3 * FORCE)


def test_relief_of_one_deflection_makes_the_error_constant():
    """At the design load, linear over the whole zone of two pairs (Harris 1958; long relief)."""
    law, zone = given_stiffness(STIFFNESS, 2.0), PATH.contact_ratio - 1.0
    ideal = Relief(FORCE / STIFFNESS, zone, "linear")
    table = relieved_table(PairGap(PATH, ideal, ideal), 0.0, law, FORCE)
    for cycle in np.linspace(0.0, 1.0, 101)[1:-1]:
        weight = in_table(table, cycle)[0]
        assert law.base + law.gain * weight[TOTAL] == pytest.approx(STIFFNESS, rel=1e-9)


def test_no_amount_of_relief_changes_nothing():
    paper = pt.load_scene("paper")
    none = {"amount": 0.0, "length": 1e-3}
    scene = paper.replace(**{"mesh.tip_relief": {"sun": none, "ring": none}})
    plain, relieved = Gearbox(paper).train.teeth, Gearbox(scene).train.teeth
    for name in ("weight", "edge", "shift", "segments", "stiffness_gain"):
        assert np.array_equal(getattr(plain, name), getattr(relieved, name))


def test_relief_lowers_the_dynamic_error_and_energy_balances():
    paper = pt.load_scene("paper").replace(
        **{"mesh.double_pair_ratio": 2.0, "mesh.damping.law": "viscous", "input_speed": 20.0}
    )
    static = 1878.8 / 2e8
    relief = {"amount": static, "length": 0.5554 * 2.34096e-3}
    both = paper.replace(**{"mesh.tip_relief": {"sun": relief, "planet": relief, "ring": {
        "amount": static, "length": 0.8092 * 2.34096e-3}}})  # fmt: skip
    swings = []
    for scene in (paper, both):
        run = pt.simulate(scene, 0.2, tolerance=1e-5)
        assert abs(run.energy.residual) < 1e-6 * run.energy.driving_work
        swings.append(run.dte.std(axis=0)[:3].mean())
    assert swings[1] < 0.35 * swings[0]


@pytest.mark.parametrize(
    "changes, message",
    [
        ({"mesh.tip_relief.sun": {"amount": 1e-6, "length": 5e-3}},
         r"mesh.tip_relief.sun.length = 0.005: must be at most 0.003641 m, the path of contact"),
        ({"mesh.tip_relief.sun": {"amount": 1e-6, "length": 1e-3}, "mesh.double_pair_ratio": 1.0},
         r"tip_relief: requires stiffness: involute, or a double_pair_ratio above 1"),
        ({"mesh.tip_relief.ring": {"amount": -1e-6, "length": 1e-3}},
         r"mesh.tip_relief.ring.amount = -1e-06: must be a number within 0 and 0.001 m"),
    ],
)  # fmt: skip
def test_impossible_reliefs_are_refused(changes, message):
    with pytest.raises(pt.SceneError, match=message):
        pt.load_scene("paper").replace(**changes)
