"""Damage of single teeth: sums of teeth are those of parts, and a faulty tooth is the one named."""

import json
import math

import numpy as np
import pytest

import planetary_twin_py as pt
from planetary_twin_py.durability.damage import DamageTotal
from planetary_twin_py.durability.damage_state import DamageState
from planetary_twin_py.durability.run_damage import RunDamage
from planetary_twin_py.durability.state_text import parse_state, state_text
from planetary_twin_py.durability.teeth import spread

CRACK = {"kind": "crack", "stiffness_loss": 0.5}


def paper(**changes):
    return pt.load_scene("paper").replace(
        **{"durability": {"teeth": True}, "dynamics": "quasi_static", **changes}
    )


def check_sums(damage):
    """Teeth add up to their parts: passages to the last one, damage to rounding."""
    assert damage.passages.any()
    for part, each in damage.of_teeth.damage.items():
        place = damage.parts.index(part)
        passages = damage.of_teeth.passages[part]
        assert len(each) == len(passages) == damage.teeth[place]
        assert passages.sum() == damage.passages[place]
        assert each.mean() == pytest.approx(damage.damage[place], rel=1e-11)


@pytest.mark.parametrize("dynamics", ["torsional", "quasi_static"])
def test_teeth_add_up_to_their_parts(dynamics):
    result = pt.simulate(paper(dynamics=dynamics), 1.0, 1e3, settling=1.0)
    assert dynamics == "quasi_static" or result.stats.repeated_steps > 1000
    check_sums(result.damage)
    for passages in result.damage.of_teeth.passages.values():
        assert np.ptp(passages) <= 2  # a healthy set takes its teeth in turn


def test_teeth_add_up_where_axes_move():
    scene = pt.load_scene("floating_sun").replace(dynamics="planar", durability={"teeth": True})
    check_sums(pt.simulate(scene, 0.1, 1e3).damage)


def of_a_passage(damage, part):
    """Mean damage of a passage of each tooth."""
    return damage.of_teeth.damage[part] / damage.of_teeth.passages[part]


@pytest.mark.parametrize("sense", [1.0, -1.0])
@pytest.mark.parametrize(("gear", "tooth"), [("sun", 11), ("planet_2", 7), ("ring", 50)])
def test_a_cracked_tooth_takes_the_least_load(gear, tooth, sense):
    """It yields, so its neighbours carry: fault and damage number teeth in the same way."""
    member, _, number = gear.partition("_")
    fault = {**CRACK, "gear": member, "tooth": tooth}
    if number:
        fault["planet"] = int(number)
    scene = paper(faults=[fault], **{"durability.ring_root": gear == "ring"})
    torque = sense * scene.operating_point.input_torque
    damage = pt.simulate(scene.replace(input_torque=torque), 0.4, 1e2).damage
    check_sums(damage)
    assert np.argmin(of_a_passage(damage, f"{gear}_root")) == tooth
    flanks = [part for part in damage.parts if part.startswith(f"{gear}_flank")]
    for part in flanks:
        if damage.of_teeth.passages[part].any():
            around = np.argsort(of_a_passage(damage, part))[:1]
            assert around[0] in (tooth, (tooth + 1) % 70, (tooth - 1) % 70)


@pytest.mark.slow
def test_repeated_cycles_give_teeth_what_computed_ones_do():
    scene = paper(dynamics="torsional", faults=[{**CRACK, "gear": "planet", "tooth": 7}])
    runs = [pt.simulate(scene, 2.0, 1e3, settling=3.0, method=m) for m in ("auto", "march")]
    assert runs[0].stats.repeated_steps > 1000
    for part in ("planet_1_root", "sun_flank_drive"):
        repeated, computed = (of_a_passage(run.damage, part) for run in runs)
        assert repeated == pytest.approx(computed, rel=0.02)
        assert np.argmin(repeated) == np.argmin(computed)


def test_sensors_do_not_shift_the_teeth_of_repeated_cycles():
    """They read ahead of the cycle that is repeated."""
    encoder = {"name": "shaft", "kind": "encoder", "shaft": "input", "lines": 1024, "rate": 6400.0}
    twin, total = pt.Twin(paper(dynamics="torsional", sensors=[encoder])), DamageTotal()
    twin.advance(2.0)
    for _ in range(100):
        window = twin.advance(0.01)
        total.add(window.damage)
    assert window.repeated
    for passages in total.total.of_teeth.passages.values():
        assert np.ptp(passages) <= 2


@pytest.mark.parametrize(("times", "stride"), [(1, 0), (3, 1), (47, -1), (1000, 7), (95, 30)])
def test_pairs_of_repeated_cycles_pass_one_after_another(times, stride):
    count = np.zeros(19, dtype=int)
    for n in range(times):
        count[(2 + n * stride) % 19] += 1
    given = (np.array([value]) for value in (2, stride, times, 19))
    _, tooth, passages = spread(*given)
    assert len(set(tooth)) == len(tooth)
    assert np.bincount(tooth, passages, 19).tolist() == count.tolist()


def test_windows_change_no_tooth():
    scene = paper(dynamics="torsional", faults=[{**CRACK, "gear": "sun"}])
    whole = pt.Twin(scene).advance(0.1).damage
    twin, total = pt.Twin(scene), DamageTotal()
    for _ in range(20):
        total.add(twin.advance(0.005).damage)
    for part, passages in whole.of_teeth.passages.items():
        assert total.total.of_teeth.passages[part].tolist() == passages.tolist()
        found = total.total.of_teeth.damage[part]
        assert found == pytest.approx(whole.of_teeth.damage[part], rel=1e-12, abs=0.0)


def test_teeth_survive_in_the_state_and_reach_the_message():
    scene = paper(faults=[{**CRACK, "gear": "sun"}])
    damage = pt.simulate(scene, 0.2, 1e2).damage
    counted = RunDamage(DamageState(damage.parts))
    counted.add(damage)
    text = state_text(counted.state, scene)
    again = RunDamage(parse_state(text, scene, damage.parts))
    assert state_text(again.state, scene) == text
    again.add(damage)
    fields = again.messages(0.0, 10.0)["damage_teeth"]
    each = np.split(fields["damage"], np.cumsum(fields["teeth"])[:-1])
    place = fields["parts"].index("sun_root")
    assert each[place] == pytest.approx(2.0 * damage.of_teeth.damage["sun_root"], rel=1e-9)
    again.replace_part("sun", 1.0)
    assert not again.state.of_teeth("sun_root", scene.gearset.teeth.sun).any()


def test_a_state_of_other_teeth_is_refused():
    scene = paper()
    damage = pt.simulate(scene, 0.1, 1e2).damage
    counted = RunDamage(DamageState(damage.parts))
    counted.add(damage)
    content = json.loads(state_text(counted.state, scene))
    content["parts"]["sun_root"]["teeth"].pop()
    with pytest.raises(ValueError, match=r"sun_root\.teeth: must have 30 entries, not 29"):
        parse_state(json.dumps(content), scene, damage.parts)


def test_without_the_field_no_tooth_is_counted():
    damage = pt.simulate(paper(durability={}), 0.1, 1e2).damage
    assert damage.of_teeth.damage == damage.of_teeth.passages == {}
    assert math.isfinite(damage.damage.sum())
