"""What is drawn depends on its place alone; a specimen is in one part, with and without faults."""

import math
from itertools import groupby

import numpy as np
import pytest
from datasets.small import SPEC, plan_of, without
from scipy.stats import chi2_contingency

from planetary_twin_py.datasets.columns import _fault


@pytest.fixture
def plan(tmp_path):
    return plan_of(tmp_path)


def test_every_specimen_has_all_states_and_one_part(plan):
    for specimen, records in groupby(plan.records(), lambda record: record.specimen):
        found = list(records)
        assert sorted(plan.states[r.state].label for r in found) == [
            "healthy",
            "sun_crack",
            "worn+cracked",
        ]
        assert [record.run for record in found] == [0, 1, 2]
        assert {record.split for record in found} == {plan.splits[specimen]}


@pytest.mark.parametrize(
    ("count", "shares", "expected"),
    [
        (5, (0.6, 0.2, 0.2), (3, 1, 1)),
        (10, (0.53, 0.27, 0.2), (5, 3, 2)),  # 5.3, 2.7 and 2: the largest remainder is added
        (7, (0.5, 0.0, 0.5), (4, 0, 3)),
        (1, (1.0, 0.0, 0.0), (1, 0, 0)),
    ],
)
def test_parts_have_their_shares_of_the_specimens(count, shares, expected, tmp_path):
    names = ("train", "validation", "test")
    given = ", ".join(f"{name}: {share}" for name, share in zip(names, shares, strict=True))
    plan = plan_of(tmp_path, without(SPEC, "specimens"), specimens=count, splits=f"{{{given}}}")
    assert tuple(plan.splits.count(name) for name in names) == expected


def test_more_specimens_and_fields_change_no_other_draw(plan, tmp_path):
    more = plan_of(
        tmp_path,
        without(SPEC, "specimens").replace("drawn:", "drawn:\n  mesh.ramp: 0.01:0.05"),
        specimens=8,
    )
    before = {record.name: record for record in plan.records()}
    after = {record.name: record for record in more.records()}
    assert len(before) == 15 and before.keys() < after.keys()
    for name, record in before.items():
        changes = dict(after[name].changes)
        assert 0.01 <= changes.pop("mesh.ramp") <= 0.05
        assert changes == record.changes


def test_records_of_a_pair_differ_in_faults_and_noise_only(plan):
    pairs = sorted(plan.records(), key=lambda record: (record.pair, record.state))
    for _, records in groupby(pairs, lambda record: record.pair):
        changes = [dict(record.changes) for record in records]
        faults = [each.pop("faults") for each in changes]
        seeds = [each.pop("sensors.0.seed") for each in changes]
        assert faults[0] == [] and len(set(seeds)) == len(changes) == 3
        assert changes[0] == changes[1] == changes[2]


def test_place_name_and_seed_say_nothing_of_the_state(tmp_path):
    """States are independent of the number of the run, which name and seeds follow."""
    plan = plan_of(tmp_path, without(SPEC, "specimens"), specimens=300)
    records = list(plan.records())
    assert [record.name for record in records] == sorted(record.name for record in records)
    places = {
        "run": [int(record.name[-4:]) for record in records],
        "seed": [record.changes["sensors.0.seed"] % 3 for record in records],
    }
    for numbers in places.values():
        counts = np.zeros((3, 3))
        np.add.at(counts, (numbers, [record.state for record in records]), 1)
        assert chi2_contingency(counts).pvalue > 1e-3


def test_levels_are_thirds_of_the_drawn_severities(tmp_path):
    plan = plan_of(tmp_path, without(SPEC, "specimens"), specimens=300)
    cracks = [record for record in plan.records() if record.state == 1]
    width = math.log(0.4 / 0.05) / 3.0
    for record in cracks:
        level = 1 + int(math.log(record.severity / 0.05) / width)
        assert record.level == level
        assert record.severity == record.changes["faults"][0]["stiffness_loss"]
    counts = [sum(record.level == level for record in cracks) for level in (1, 2, 3)]
    assert min(counts) > 100 - 5 * math.sqrt(300 * 2 / 9)


def test_distributions_have_their_moments(tmp_path):
    plan = plan_of(tmp_path, without(SPEC, "specimens"), specimens=1000)
    healthy = [record for record in plan.records() if record.state == 0]
    pins = np.array([[r.drawn[f"errors.pin_tangential.{n}"] for n in range(3)] for r in healthy])
    assert abs(pins.mean()) < 5 * 2e-6 / math.sqrt(pins.size)
    assert pins.std() == pytest.approx(2e-6, rel=5 / math.sqrt(2 * pins.size))
    assert np.abs(np.corrcoef(pins.T)[np.triu_indices(3, 1)]).max() < 5 / math.sqrt(1000)
    stiff = np.array([record.drawn["mesh.sun_planet_stiffness"] for record in healthy])
    assert stiff.min() >= 1.9e8 and stiff.max() <= 2.1e8
    assert stiff.std() == pytest.approx(0.2e8 / math.sqrt(12), rel=0.1)


def test_new_kinds_of_faults_have_labels_and_severities(tmp_path):
    """The severity is the first that is drawn, whatever other numbers are drawn before it."""
    faults = """
  - {kind: pitch, gear: sun, grade: 6, seed: 0:999, scale: 0.5:2}
  - {kind: pin, planet: 1:3, radial: 5um:20um}
  - {kind: wear, gear: planet, planet: all, tooth: all, depth: 1um:5um}
  - {kind: crack, gear: sun, angle: 1:1.5, stiffness_loss: 0.1:0.2}
"""
    rest = {"operating_points": "[{input_speed: 900rpm:1100rpm}]", "duration": "0.05 s"}
    plan = plan_of(tmp_path, SPEC.split("faults:")[0], faults=faults, **rest)
    labels = {state.label: state.severity for state in plan.states[1:]}
    assert labels == {
        "sun_pitch": "faults.0.scale",
        "pin": "faults.0.radial",
        "planet_wear": "faults.0.depth",
        "sun_crack": "faults.0.stiffness_loss",
    }
    columns = [_fault(plan.scene.replace(**record.changes).faults) for record in plan.records()]
    found = {(each["fault_type"], each["fault_location"], each["tooth"]) for each in columns}
    assert found == {
        ("normal", "none", "none"), ("pitch", "sun", "none"), ("pin", "planet", "none"),
        ("wear", "planet", "all"), ("crack", "sun", "0"),
    }  # fmt: skip
