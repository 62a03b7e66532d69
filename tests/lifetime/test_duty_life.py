"""Lives under a duty, from the call and from the command."""

import json

import numpy as np
import pytest
import yaml
from command_line import invoke, succeed
from lifetime.stages import stage

import planetary_twin_py as pt
from planetary_twin_py.durability.damage_state import DamageState
from planetary_twin_py.durability.parts import part_names
from planetary_twin_py.durability.state_text import state_text

SCENE = stage("helicopter_stage").replace(dynamics="quasi_static")
POINT = SCENE.operating_point
YEAR = 31_557_600.0


def steady():
    columns = {"input_torque": np.array([1300.0]), "input_speed": np.array([POINT.input_speed])}
    return pt.Duty(np.array([3600.0]), columns)


@pytest.fixture(scope="module")
def constant():
    return pt.duty_life(SCENE, steady(), repeat=YEAR, excerpts=2)


def test_a_constant_torque_does_the_damage_of_its_run(constant):
    run = pt.simulate(SCENE, 0.5, 1000.0, settling=0.01).damage  # 283 mesh cycles
    np.testing.assert_allclose(constant.damage, run.rate * YEAR, rtol=0.01)
    passages = run.passages_per_tooth / run.duration * YEAR
    np.testing.assert_allclose(constant.passages, passages, rtol=0.01)
    place = constant.parts.index(constant.first)
    assert constant.life[place] == pytest.approx(YEAR / constant.damage[place])
    assert constant.life[place] == constant.life.min()


def test_a_constant_torque_is_its_own_equivalent(constant):
    same = constant.equivalent
    assert (same.torque, same.application_factor) == pytest.approx((1300.0, 1.0))
    assert same.turns == pytest.approx(YEAR * POINT.input_speed / (2.0 * np.pi))


def test_strength_costs_a_power_of_itself(constant):
    lives = {each.change: each.life for each in constant.sensitivity}
    longer, shorter = lives["strength +5 %"], lives["strength -5 %"]
    assert 1.05**13.0 < longer < 1.05**33.0
    assert 0.95**33.0 < shorter < 0.95**13.0
    assert any("mesh.ramp" in change for change in lives)
    assert "mesh.entry = loaded" in lives


def test_what_has_happened_before_shortens_what_remains(constant):
    worn = pt.duty_life(SCENE, steady(), YEAR, {constant.first: 0.9}, excerpts=2)
    assert worn.remaining.median < constant.remaining.median
    np.testing.assert_array_equal(worn.damage, constant.damage)
    with pytest.raises(ValueError, match="'tooth': no such part"):
        pt.duty_life(SCENE, steady(), YEAR, {"tooth": 0.9})


def test_lives_go_on_from_a_state_file_and_its_replaced_parts(tmp_path, constant):
    """The same duty again: what is left is the life less the time, and that of survivors."""
    again = tmp_path / "gearbox.json"
    state = DamageState(constant.parts)
    state.damage.add(np.full((1, len(constant.parts)), 0.25))
    state.replace_part("planet_2")
    again.write_text(state_text(state, SCENE))
    before = again.read_bytes()
    (tmp_path / "scene.yaml").write_text(yaml.safe_dump(SCENE.model_dump(mode="json")))
    speed = POINT.input_speed
    (tmp_path / "duty.csv").write_text(f"duration,torque,speed\n3600,1300,{speed!r}\n")
    done = succeed(
        "durability", tmp_path / "scene.yaml", "--duty", tmp_path / "duty.csv", "--repeat", "1h",
        "--excerpts", 2, "--state", again, "--json", tmp_path / "found.json",
    )  # fmt: skip
    found = json.loads((tmp_path / "found.json").read_text())
    assert again.read_bytes() == before
    for part, life in zip(constant.parts, constant.life, strict=True):
        reached = 0.0 if part.startswith("planet_2") and "bearing" not in part else 0.25
        assert found["parts"][part]["reached"] == reached
        if np.isfinite(life):
            assert found["parts"][part]["left"] == pytest.approx((1.0 - reached) * life, rel=1e-9)
    assert found["tenth"] < constant.tenth
    assert "damage so far" in done.output


def test_a_state_of_another_gear_set_is_refused(tmp_path):
    other = tmp_path / "other.json"
    other.write_text(state_text(DamageState(part_names(SCENE)), SCENE))
    (tmp_path / "duty.csv").write_text("duration,torque,speed\n9,60,100\n")
    done = invoke(
        "durability", "paper", "--set", "durability={}", "--duty", tmp_path / "duty.csv",
        "--state", other,
    )  # fmt: skip
    assert done.exit_code == 2 and "another gear set" in done.output
    assert len(done.output.strip().splitlines()) == 1


def test_a_duty_below_an_endless_curve_damages_nothing():
    scene = SCENE.replace(**{"durability.material": {"beyond": "endless"}})
    light = steady()._replace(columns=steady().columns | {"input_torque": np.array([300.0])})
    found = pt.duty_life(scene, light)
    assert found.first == "" and not found.damage.any() and not found.sensitivity
    assert np.isinf(found.life).all() and found.error.excerpts == 0
    json.dumps(found.figures(), allow_nan=False)


def test_cycles_of_the_torque_wear_out_a_shaft():
    """Two ranges an hour, of 1000 and 2000 N m: closed form of Miner's sum."""
    shafts = {"input": {"range": 4000.0, "exponent": 5.0, "reference_cycles": 1e6}}
    scene = SCENE.replace(**{"durability.shafts": shafts})
    torque = np.array([0.0, 1000.0, 0.0, 2000.0])
    columns = {"input_torque": torque, "input_speed": np.full(4, 100.0)}
    duty = pt.Duty(np.full(4, 900.0), columns, 900.0 * np.arange(4))
    found = pt.duty_life(scene, duty, excerpts=2)
    damage = found.damage[found.parts.index("input_shaft")]
    assert damage == pytest.approx((0.25**5 + 0.5**5) / 1e6, rel=1e-6)


def test_the_command_prints_and_writes_what_the_call_finds(tmp_path):
    (tmp_path / "duty.csv").write_text(
        "time [min],torque [N m],speed [rpm]\n0,1300,1600\n10,900,1500\n20,-500,1600\n30,0,0\n"
    )
    scene = tmp_path / "scene.yaml"
    scene.write_text("base: paper\ndurability: {}\ndynamics: quasi_static\n")
    duty = (tmp_path / "duty.csv").read_text().replace("1300", "60").replace("900", "40")
    (tmp_path / "duty.csv").write_text(duty.replace("-500", "-20"))
    done = succeed(
        "durability", scene, "--duty", tmp_path / "duty.csv", "--repeat", "20y", "--excerpts", 3,
        "--out", tmp_path / "loads.png", "--json", tmp_path / "found.json",
    )  # fmt: skip
    found = json.loads((tmp_path / "found.json").read_text())
    assert found["time"] == pytest.approx(20 * YEAR)
    assert f"fails first: {found['first']}" in done.output
    assert "input_torque_std" in done.output and "one block" in done.output
    first = found["parts"][found["first"]]
    assert first["damage"] == pytest.approx(found["time"] / first["life"])
    hours = np.sum(found["loads"]["duration"]) / 3600.0
    assert hours == pytest.approx(20 * YEAR / 3600.0)
    assert (tmp_path / "loads.png").stat().st_size > 10_000


@pytest.mark.parametrize(
    ("text", "options", "reason"),
    [
        ("share,torque,speed\n1,60,100\n", (), "repeat: required"),
        ("duration,torque,speed\n9,60,100\n", ("--block", "1d"), "column time has an order"),
        ("duration,torque,speed\n9,60,100\n", ("--excerpts", "1"), "must be at least 2"),
        ("duration,torque,speed\n9,60,9999\n", (), r"row 1: input_speed = 9999 rad/s"),
        ("duration,torque,speed\n9,0,100\n", (), "never turns under a torque"),
    ],
)
def test_a_duty_without_an_answer_is_refused_in_one_line(tmp_path, text, options, reason):
    (tmp_path / "duty.csv").write_text(text)
    done = invoke(
        "durability", "paper", "--set", "durability={}", "--set", "dynamics=quasi_static",
        "--duty", tmp_path / "duty.csv", *options,
    )  # fmt: skip
    assert done.exit_code == 2
    assert reason in done.output and len(done.output.strip().splitlines()) == 1


def test_a_recording_is_a_duty(tmp_path):
    scene = tmp_path / "scene.yaml"
    scene.write_text("base: paper\ndurability: {}\n")
    assert invoke(
        "simulate", scene, "--duration", "0.5", "--out", tmp_path / "run.mcap"
    ).exit_code == 0  # fmt: skip
    succeed(
        "durability", scene, "--from", tmp_path / "run.mcap", "--excerpts", 2,
        "--json", tmp_path / "found.json",
    )  # fmt: skip
    found = json.loads((tmp_path / "found.json").read_text())
    run = pt.simulate(pt.load_scene(scene), 0.5, 1000.0, settling=0.5).damage
    assert found["time"] == pytest.approx(0.5, rel=0.03)
    place = run.parts.index("sun_flank_drive")
    rate = found["parts"]["sun_flank_drive"]["damage"] / found["time"]
    assert rate == pytest.approx(run.rate[place], rel=0.25)


def test_a_duty_comes_from_one_file():
    for options in ((), ("--duty", "a.csv", "--from", "b.mcap")):
        done = invoke("durability", "paper", *options)
        assert done.exit_code == 2 and "--duty, --from: give one of them" in done.output
