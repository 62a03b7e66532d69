"""Damage of a simulated gearbox: published, saved, continued after kill -9, and verified."""

import json

import pytest
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from planetary_twin.simulation.damage import SimulatedDamage
from planetary_twin_msgs.msg import DamageState, DamageTeeth
from planetary_twin_msgs.srv import ReplacePart
from std_srvs.srv import Trigger

import planetary_twin_py as pt
from planetary_twin_py.durability.state_text import state_text
from planetary_twin_py.recording.runs.verify import verify

from ..aging import PARTS, SCENE, saved, scene_file, sums_of
from ..peer import LATCHED, LONG, TWIN
from ..programs import refuses
from ..reported import check_rising, check_verified, statuses

NODE = f"{TWIN}/simulation"


def save(peer):
    answer = peer.call(Trigger, f"{NODE}/save_damage", Trigger.Request())
    assert answer.success, answer.message
    return answer.message


def replace(peer, part):
    return peer.call(ReplacePart, f"{NODE}/replace_part", ReplacePart.Request(part=part))


def test_after_kill_9_damage_goes_on_from_the_last_save(peer, start, tmp_path):
    scene, path = scene_file(tmp_path), tmp_path / "state.json"
    given = {"scene": scene, "damage_file": path, "dynamics": "quasi_static"}
    del given["dynamics"]
    messages = peer.listen(DamageState, f"{TWIN}/damage_state", LATCHED)
    node = start("planetary_twin.simulation", **given)
    peer.until(lambda: len(messages) >= 2)
    assert save(peer) == str(path)
    last = saved(path)
    peer.until(lambda: messages[-1].hours > last.hours + 0.5 / 3600.0)
    node.kill()
    node.wait(LONG)
    assert state_text(saved(path), SCENE) == state_text(last, SCENE)
    first = messages[0]
    messages.clear()
    start("planetary_twin.simulation", **given)
    peer.until(lambda: messages)
    again = messages[0]
    assert again.hours == pytest.approx(last.hours + first.hours, rel=1e-9)
    before = dict(zip(PARTS, last.sums, strict=True))
    for part, damage in sums_of(again).items():
        # The second run begins as the first: the same passages in its first second.
        assert damage == pytest.approx(before[part] + sums_of(first)[part], rel=1e-6)
    assert any(before.values())
    check_rising(messages)


def test_a_replaced_part_is_recorded_and_verified(peer, start, tmp_path):
    logger = start("planetary_twin.logger", name="rig")
    scene, path = scene_file(tmp_path), tmp_path / "state.json"
    messages = peer.listen(DamageState, f"{TWIN}/damage_state", LATCHED)
    teeth = peer.listen(DamageTeeth, f"{TWIN}/damage_teeth")
    start("planetary_twin.simulation", scene=scene, damage_file=path, wait_for="logger")
    peer.until(lambda: messages)
    answer = replace(peer, "planet_2")
    own = [part for part in PARTS if part.startswith("planet_2_") and "bearing" not in part]
    assert answer.success and answer.parts == own
    assert [entry.part for entry in saved(path).replaced] == own  # written at once
    refusal = replace(peer, "moon")
    assert not refusal.success and refusal.message.startswith("part = 'moon': must be one of sun")
    peer.until(lambda: messages[-1].replaced)
    peer.until(lambda: teeth)
    counts = SCENE.gearset.teeth
    assert len(teeth[0].damage) == sum(teeth[0].teeth)
    assert dict(zip(teeth[0].parts, teeth[0].teeth, strict=True))["sun_root"] == counts.sun
    peer.change_state(NODE, "deactivate")
    peer.change_state(f"{TWIN}/logger", "deactivate")
    check_verified(logger, tmp_path / "recordings" / "rig")
    verdict = verify(tmp_path / "recordings" / "rig", TWIN)
    assert verdict.messages["damage_state"] == len(messages)
    assert verdict.messages["damage_teeth"] == len(teeth)
    assert json.loads(path.read_text())["replaced"]


@pytest.mark.parametrize("kind", ["foreign", "spoilt"])
def test_a_file_that_is_not_its_own_is_refused_and_kept(peer, start, tmp_path, kind):
    scene, path = scene_file(tmp_path), tmp_path / "state.json"
    from planetary_twin_py.durability.damage_state import DamageState as State

    text = state_text(State(PARTS), SCENE.replace(**{"gearset.face_width": 0.05}))
    path.write_text(text if kind == "foreign" else text[:100])
    before = path.read_bytes()
    node = start("planetary_twin.simulation", scene=scene, damage_file=path)
    refuses(node, str(path), "another gear set" if kind == "foreign" else "cut off")
    assert path.read_bytes() == before


def test_a_scene_without_materials_has_no_file_of_damage(start, tmp_path):
    node = start("planetary_twin.simulation", damage_file=tmp_path / "state.json")
    refuses(node, "damage_file: the scene needs its section durability")
    assert not (tmp_path / "state.json").exists()


def test_damage_near_one_is_a_warning_and_above_an_error(peer, start, tmp_path):
    from planetary_twin_py.durability.damage_state import DamageState as State

    scene, path = scene_file(tmp_path), tmp_path / "state.json"
    state = State(PARTS)
    terms = [[0.85 if part == "sun_root" else 0.0 for part in PARTS]]
    state.damage.add(terms)
    path.write_text(state_text(state, SCENE))
    reports = peer.listen(DiagnosticArray, "/diagnostics")
    start("planetary_twin.simulation", scene=scene, damage_file=path)

    def reported(level, words):
        found = statuses(reports, "simulation: damage")
        return [one for one in found if one.level == level and words in one.message]

    peer.until(lambda: reported(DiagnosticStatus.WARN, "damage of 0.8 or more: sun_root 0.85"))
    assert replace(peer, "sun_root").success
    peer.until(lambda: reported(DiagnosticStatus.OK, "largest"))


def test_the_next_run_starts_at_the_temperatures_in_the_file(tmp_path):
    warm = {
        "oil": {"mass": 0.01},
        "gears": {"to_oil": 2000.0},
        "housing": {"mass": 0.4, "area": 0.1, "height": 0.2, "from_oil": 10.0},
    }
    scene, path = SCENE.replace(dynamics="quasi_static", thermal=warm), tmp_path / "state.json"
    damage, twin = SimulatedDamage(scene, path), pt.Twin(scene, 1000.0)
    assert damage.warmed(scene) == scene
    damage.begin()
    damage.add(twin.advance(2.0))
    damage.save()
    again = pt.Twin(SimulatedDamage(scene, path).warmed(scene), 1000.0)
    assert again.temperatures == twin.temperatures
    assert again.temperatures["oil"] > scene.operating_point.ambient_temperature + 0.1
    assert SimulatedDamage(scene, None).warmed(scene) == scene
