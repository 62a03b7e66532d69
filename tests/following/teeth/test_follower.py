"""Cracked and worn teeth of plants whose faults are known."""

import numpy as np
import pytest
from following.plants import TEETH_LAWS, crack, hunted, toothed
from tiers import first

from planetary_twin_py.following.teeth.kind import ToothKind
from planetary_twin_py.following.teeth.signatures import signatures

LEARNED = 22.0  # [s]
SUN = ({"at": LEARNED, "faults": [crack("sun", 7, 0.01)]},)


@pytest.fixture(scope="module")
def cracked():
    """A crack of 1 % of a sun tooth, and later a load of 130 %."""
    return toothed({}, (*SUN, {"at": 30.0, "load": 1.3}), 42.0)


@pytest.mark.exhaustive
def test_a_crack_of_one_percent_is_found_within_four_seconds(cracked):
    (event,) = cracked[1].events
    assert event.what == "sun tooth 7 changed"
    assert LEARNED < event.found < LEARNED + 4.0


@pytest.mark.exhaustive
def test_no_stated_interval_misses_the_size_or_the_start():
    at = LEARNED + 0.4  # within a hunting period
    changes = ({"at": at, "faults": [crack("planet", 3, 0.012, planet=2)]},)
    stated = []
    for _, follower in hunted({}, changes, LEARNED + 14.0, seed=4):
        for event in follower.events:
            assert event.since <= at < event.found
        stated += [one.loss for one in follower.teeth]
    assert stated[0].status == "LEARNING"  # only a part of its hunting period was cracked
    sizes = [one for one in stated if one.status == "ESTIMATED"]
    assert len(sizes) > 12
    assert all(one.low < 0.012 < one.high for one in sizes)


@pytest.mark.exhaustive
def test_a_change_of_load_identifies_a_crack(cracked):
    assert cracked[1].events[0].causes == ("crack",)


@pytest.mark.exhaustive
def test_the_compliance_is_that_of_the_model(cracked):
    plant, follower = cracked
    found = {one.name: one for one in follower.estimates()}["compliance"]
    point = plant.scene.operating_point
    model = signatures(plant.scene, point.input_torque, point.input_speed).compliance
    assert found.status == "ESTIMATED"
    assert found.value == pytest.approx(model / follower.train.lever, rel=0.02)


@pytest.mark.exhaustive
def test_a_change_of_load_identifies_wear():
    worn = {"kind": "wear", "gear": "sun", "tooth": 7, "depth": 2e-7}
    _, follower = toothed({}, ({"at": LEARNED, "faults": [worn]}, {"at": 30.0, "load": 1.3}), 42.0)
    (event,) = follower.events
    assert event.what == "sun tooth 7 changed" and event.causes == ("wear",)


@pytest.mark.exhaustive
def test_two_teeth_are_distinguished():
    faults = [crack("sun", 20, 0.02), crack("ring", 5, 0.03)]
    _, follower = toothed({}, ({"at": LEARNED, "faults": faults},), 28.0)
    found = {(one.gear, one.tooth): one.loss for one in follower.teeth}
    assert set(found) == {("sun", 20), ("ring", 5)}
    assert found["sun", 20].value == pytest.approx(0.02, rel=0.15)
    assert found["ring", 5].value == pytest.approx(0.03, rel=0.15)


def test_without_a_learned_baseline_nothing_is_judged():
    _, follower = toothed({}, (), 12.0)
    assert not follower.events and not follower.teeth
    assert any("of 24 hunting periods" in line for line in follower.remarks())


def test_at_one_load_crack_and_wear_are_not_distinguished():
    kind = ToothKind(24)
    for _ in range(30):
        kind.add(0, 63.0, 0.01, 7e-4)
    assert set(kind.kinds) == {"crack", "wear"}


@pytest.mark.exhaustive
@pytest.mark.parametrize("law", first(2, TEETH_LAWS, pytest.mark.release))
def test_teeth_of_all_gears_are_named_with_other_laws(law):
    limit = {"sun": 4.0, "planet": 4.0, "ring": 14.0}
    chance = np.random.default_rng([*TEETH_LAWS].index(law))
    inside = []
    for gear, teeth in (("sun", 30), ("planet", 20), ("ring", 70)):
        number = int(chance.integers(teeth))
        more = {"planet": int(chance.integers(1, 4))} if gear == "planet" else {}
        changes = ({"at": LEARNED, "faults": [crack(gear, number, 0.01, **more)]},)
        _, follower = toothed(TEETH_LAWS[law], changes, LEARNED + 8.0, seed=number)
        assert len(follower.events) == 1, (gear, number)
        name = f"{gear}_{more['planet']}" if more else gear
        (tooth,) = follower.teeth
        assert f"{name} tooth {number}" in tooth.candidates
        assert follower.events[0].found < LEARNED + limit[gear]
        inside.append(tooth.loss.low < 0.01 < tooth.loss.high)
    assert all(inside)


@pytest.mark.exhaustive
@pytest.mark.parametrize("law", ["the same", "runout"])
def test_healthy_teeth_give_no_alarm(law):
    _, follower = toothed(TEETH_LAWS[law], (), 150.0, seed=11)
    assert not follower.events
    assert follower.blocks > 150


@pytest.mark.exhaustive
def test_jitter_hides_small_cracks_and_none_is_invented():
    _, follower = toothed({}, SUN, 40.0, encoders={"jitter": 1e-6})
    assert not follower.events
