"""Readings and encoders of a plant against runs of the twin with dynamics."""

import numpy as np
import pytest
from command_line import run_here

import planetary_twin_py as pt
from planetary_twin_py.following.train import followed_train
from planetary_twin_py.plant.hidden import Hidden, read_hidden
from planetary_twin_py.plant.readings import Plant, simulate_readings
from planetary_twin_py.plant.sampled import simulate_samples

SCENE = pt.load_scene("paper")
STILL = {"torque_wander": 0.0, "speed_wander": 0.0}


def play(hidden, duration=2.0):
    plant = Plant(SCENE, Hidden.model_validate(hidden), duration)
    return plant, *simulate_readings(plant)


def test_steady_readings_are_those_of_the_twin_with_dynamics():
    _, _, columns = play({"duty": STILL})
    twin = pt.Twin(SCENE)
    twin.advance(0.5)
    window = twin.advance(0.5)
    means = {name: float(np.mean(values)) for name, values in columns.items()}
    assert means["input_torque"] == pytest.approx(window.input_torque, rel=1e-3)
    assert means["output_torque"] == pytest.approx(window.output_torque, rel=1e-3)
    assert means["input_speed"] == pytest.approx(window.input_speed, rel=1e-3)
    assert means["output_speed"] == pytest.approx(window.output_speed, rel=1e-3)
    lost = means["input_torque"] + followed_train(SCENE).ratio * means["output_torque"]
    assert lost == pytest.approx(window.power_loss / window.input_speed, rel=0.02)


@pytest.mark.parametrize(("kind", "quadrants"), [("varied", 1), ("four_quadrant", 4)])
def test_readings_balance_with_inertia_while_the_speed_changes(kind, quadrants):
    plant, time, columns = play({"duty": {"kind": kind}}, 20.0)
    train = followed_train(SCENE)
    energy = 0.5 * train.inertia * plant.course.speed_at(time) ** 2
    power = (
        columns["input_torque"] * columns["input_speed"]
        + columns["output_torque"] * columns["output_speed"]
    )
    stored = np.gradient(energy, time)
    lost = power - stored
    smooth = np.abs(np.gradient(plant.course.acceleration_at(time))) < 1e-9
    assert np.all(lost[smooth] > 0.0)
    assert np.ptp(stored[smooth]) > 100.0  # [W], far more than is lost
    assert np.max(lost[smooth]) < 0.02 * 63.0 * 1.3 * 105.0
    held = np.abs(plant.course.acceleration_at(time)) < 10.0
    signs = np.sign([columns["input_torque"][held], columns["input_speed"][held]])
    assert np.unique(signs, axis=1).shape[1] == quadrants


def test_changes_come_at_their_time():
    _, time, columns = play(
        {"duty": STILL, "changes": [{"at": 1.0, "friction": 1.2}, {"at": 1.5, "torque_zero": 0.5}]}
    )
    lost = columns["input_torque"] + followed_train(SCENE).ratio * columns["output_torque"]
    before, after = lost[time < 1.0].mean(), lost[(time > 1.0) & (time < 1.5)].mean()
    assert after / before == pytest.approx(1.2, rel=1e-6)
    assert lost[time > 1.5].mean() - after == pytest.approx(0.5, rel=1e-6)


def test_the_same_seed_gives_the_same_readings():
    hidden = {"duty": {"kind": "reversing"}, "sensors": {"input_torque": {"noise": 0.1}}}
    one, other, third = play(hidden)[2], play(hidden)[2], play(hidden | {"seed": 1})[2]
    assert np.array_equal(one["input_torque"], other["input_torque"])
    assert not np.array_equal(one["input_torque"], third["input_torque"])


def test_encoders_show_the_transmission_error_of_the_twin():
    perfect = {"bits": 30, "noise": 0.0, "long_wave": 0.0, "mesh_wave": 0.0, "delay": 0.0}
    hidden = {"duty": STILL, "sensors": {"encoders": {"rate": 20_000.0, **perfect}}}
    plant = Plant(SCENE, Hidden.model_validate(hidden), 0.1)
    (packet,) = simulate_samples(plant, "encoders")
    turned = packet.values / 2.0**30 * 2.0 * np.pi
    shown = turned[:, 0] + 7.0 / 3.0 * turned[:, 1]
    run = pt.simulate(SCENE, 0.1, 20_000.0, tolerance=1e-5, settling=1.0)
    sun, ring = (run.angle[:, run.bodies.index(body)] for body in ("sun", "ring"))
    true = sun + 7.0 / 3.0 * ring
    assert np.mean(shown) == pytest.approx(np.mean(true), rel=2e-3)
    assert np.std(shown) == pytest.approx(np.std(true), rel=0.02)
    assert shown.min() == pytest.approx(true.min(), rel=0.02)


def test_lost_packets_and_quantisation_are_as_given():
    hidden = {"sensors": {"encoders": {"rate": 20_000.0, "bits": 12, "lost": 0.1}}}
    plant = Plant(SCENE, Hidden.model_validate(hidden), 5.0)
    sample = np.concatenate([packet.sample for packet in simulate_samples(plant, "encoders")])
    assert 0.85 < len(sample) / 100_000 < 0.95
    assert set(np.diff(np.flatnonzero(np.diff(sample) > 1)) % 200) == {0}


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("duty: {kind: idle}", "duty.kind = 'idle': must be"),
        ("changes: [{friction: 2}]", r"changes\.0\.at: missing"),
        ("sensors: {encoders: {lost: 2}}", r"sensors\.encoders\.lost = 2"),
        ("sensor: {}", "sensor: no such field"),
        (
            "changes: [{at: 0, friction_factor: 2}]",
            r"changes\.0\.friction_factor: no such field; there are at, drag, faults",
        ),
    ],
)
def test_fields_of_the_hidden_state_are_checked(tmp_path, text, message):
    file = tmp_path / "hidden.yaml"
    file.write_text(text)
    with pytest.raises(pt.SceneError, match=message):
        read_hidden(file)


FAULTY = """
scene: {{{scene}}}
changes: [{{at: 0, faults: [{{kind: crack, gear: {gear}, stiffness_loss: 0.3}}]}}]
"""


@pytest.mark.parametrize(
    ("gear", "scene", "message"),
    [
        ("planet, planet: 5", "", r"changes\.0\.faults\.0\.planet = 5: must be at most 3"),
        ("sun, tooth: 45", "", r"changes\.0\.faults\.0\.tooth = 45: must be at most 29"),
        ("sun", "mesh.nosuch: 1", r"scene: mesh\.nosuch: no such field"),
    ],
)
def test_what_does_not_fit_the_scene_is_refused_at_once(tmp_path, gear, scene, message):
    file = tmp_path / "hidden.yaml"
    file.write_text(FAULTY.format(gear=gear, scene=scene))
    with pytest.raises(pt.SceneError, match=rf"hidden\.yaml: {message}"):
        read_hidden(file, SCENE)
    with pytest.raises(pt.SceneError, match=message):
        Plant(SCENE, read_hidden(file), 1.0)


@pytest.mark.parametrize("step", [1, -1])  # of the list: in order of time, and against it
def test_a_value_of_a_change_replaces_the_one_before(step):
    changes = [{"at": 1.0, "load": 0.5, "friction": 1.2}, {"at": 1.5, "load": 0.8}]
    plant, time, _ = play({"duty": STILL, "changes": changes[::step]})
    torque = plant.course.torque_at(time) / plant.train.torque
    assert torque[time < 0.9] == pytest.approx(1.0)
    assert torque[(time > 1.1) & (time < 1.4)] == pytest.approx(0.5)
    assert torque[time > 1.6] == pytest.approx(0.8)
    assert set(plant.at("friction", time[time > 1.0], 1.0)) == {1.2}


def test_the_command_warns_of_changes_after_its_end(tmp_path):
    path = tmp_path / "late.yaml"
    path.write_text("changes: [{at: 0.5 s, friction: 1.2}, {at: 90 s, friction: 1.3}]")
    command = "plant", "paper", "--hidden", path, "--out", tmp_path / "readings.csv"
    said = run_here(*command, "--duration", "1")
    assert said.stderr.splitlines() == [
        "planetary-twin: warning: changes: those at 90 s or later have no effect: the simulation "
        "ends at 1 s"
    ]
