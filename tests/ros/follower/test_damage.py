"""Damage of a measured gearbox in the follower: counted once, saved, continued, replaced."""

import pytest
from planetary_twin_msgs.msg import DamageState
from planetary_twin_msgs.srv import ReplacePart
from std_srvs.srv import Trigger

from planetary_twin_py.durability.state_text import state_text

from ..aging import PARTS, SCENE, saved, scene_file, sums_of
from ..peer import LATCHED, LONG
from .test_inputs import FOLLOWER, Rig, begin


def test_killed_follower_goes_on_without_counting_twice(peer, start, tmp_path):
    rig, path = Rig(peer), tmp_path / "state.json"
    scene = scene_file(tmp_path)
    messages = peer.listen(DamageState, f"{FOLLOWER}/damage_state", LATCHED)
    first = start("planetary_twin.follower", scene=scene, damage_file=path)
    rig.wait_for_the_follower()
    rig.send(0.0, 6.0)
    peer.until(lambda: messages and messages[-1].hours * 3600.0 > 4.5)
    answer = peer.call(Trigger, f"{FOLLOWER}/save_damage", Trigger.Request(), LONG)
    assert (answer.success, answer.message) == (True, str(path))
    before = saved(path)
    assert before.sums.max() > 0.0
    rig.send(6.0, 8.0)
    first.kill()
    first.wait(LONG)
    assert state_text(saved(path), SCENE) == state_text(before, SCENE)
    messages.clear()
    start("planetary_twin.follower", scene=scene, damage_file=path)
    publishers = (rig.joints, rig.oil, rig.encoders)
    # The middleware takes minutes to forget the follower that was killed.
    peer.until(lambda: all(rig.is_matched(each, 2) for each in publishers))
    rig.send(0.0, 12.0)  # a recording that is played again, and goes on
    peer.until(lambda: messages and messages[-1].hours * 3600.0 > 10.5)
    peer.change_state(FOLLOWER, "deactivate")
    after = saved(path)
    assert after.hours * 3600.0 == pytest.approx(11.99, abs=0.02)
    assert float(after.times.unknown.total) == 0.0
    whole = 11.99 / (before.hours * 3600.0)  # the load is steady
    assert after.sums == pytest.approx(whole * before.sums, rel=0.02)


def test_a_bearing_is_replaced_while_readings_arrive(peer, start, tmp_path):
    rig, path = Rig(peer), tmp_path / "state.json"
    messages = peer.listen(DamageState, f"{FOLLOWER}/damage_state", LATCHED)
    begin(start, rig, scene=scene_file(tmp_path), damage_file=path)
    rig.send(0.0, 4.0)
    peer.until(lambda: messages and messages[-1].hours * 3600.0 > 2.5)
    request = ReplacePart.Request(part="planet_1_bearing")
    answer = peer.call(ReplacePart, f"{FOLLOWER}/replace_part", request, LONG)
    assert answer.success and answer.parts == ["planet_1_bearing"]
    (entry,) = saved(path).replaced
    assert entry.part == "planet_1_bearing" and entry.damage > 0.0
    rig.send(4.0, 8.0)
    peer.until(lambda: messages[-1].replaced and messages[-1].hours * 3600.0 > 6.5)
    sums = sums_of(messages[-1])
    assert 0.0 < sums["planet_1_bearing"] < sums["planet_2_bearing"]
    assert set(sums) == set(PARTS)
