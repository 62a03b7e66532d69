"""Measured waveforms become a recording that other commands open."""

import json

import numpy as np
import pytest
from command_line import invoke, succeed
from scipy.io import wavfile

from planetary_twin_py.analysis.signals.recorded_sensor import Span, read_sensor_signal

RATE = 12_800
TIME = np.arange(3 * RATE) / RATE
TURNS = (900.0 * TIME + 50.0 * TIME**2) / 60.0  # of the input, from 900 to 1200 rpm
SIGNAL = 0.5 * np.sin(2.0 * np.pi * 30.0 * TURNS)


@pytest.fixture(scope="module")
def rig(tmp_path_factory):
    folder = tmp_path_factory.mktemp("rig")
    wavfile.write(folder / "rig.wav", RATE, SIGNAL.astype("f4"))
    torque = np.column_stack((TIME[::64], 63.0 + TIME[::64], 900.0 + 100.0 * TIME[::64]))
    heading = "time [s],torque [N m],speed [rpm]"
    np.savetxt(folder / "slow.csv", torque, header=heading, delimiter=",", comments="")
    pulses = (-900.0 + np.sqrt(900.0**2 + 12_000.0 * np.arange(int(TURNS[-1]) + 1))) / 100.0
    np.savetxt(folder / "pulses.csv", pulses, header="time [s]", comments="")
    return folder


def imported(rig, name, shaft):
    (rig / f"{name}.yaml").write_text(
        "sensors:\n  ring_top: {column: 1, full_scale: 10 V, sensitivity: 100 mV/g}\n"
        f"{shaft}\n"
        "torques:\n  input: {file: slow.csv, column: torque}\n"
    )
    done = succeed(
        "import", rig / "rig.wav", "--sensors", rig / f"{name}.yaml", "--out", rig / name
    )
    return rig / name, done.stdout


@pytest.mark.parametrize(
    ("name", "shaft"),
    [
        ("speed", "speed: {file: slow.csv, column: speed}"),
        ("tachometer", "tachometer: {file: pulses.csv}"),
    ],
)
def test_orders_of_a_run_up_are_those_of_the_recording(rig, name, shaft):
    file, text = imported(rig, name, shaft)
    assert "input speed 900.5 to 11" in text and "samples at 12800 Hz [g]" in text
    done = succeed("spectrum", file, "--sensor", "ring_top", "--order", "--json", "-")
    line = json.loads(done.stdout)["lines"][0]
    assert line["order"] == pytest.approx(30.0, abs=0.01)
    assert line["amplitude"] == pytest.approx(50.0, rel=2e-3)
    assert line["name"] == "mesh harmonic 1"
    state = invoke("info", file).stdout
    assert "ring_top [g] at 12800 Hz" in state and ("PulseTimes" in state) == (name != "speed")


def test_samples_are_those_of_the_file(rig):
    (rig / "plain.yaml").write_text("sensors:\n  a: {full_scale: 1 g}\n")
    done = invoke(
        "import", rig / "rig.wav", "--sensors", rig / "plain.yaml", "--out", rig / "p.mcap"
    )
    assert (
        done.exit_code == 0 and "no speed was measured: that of the scene is assumed" in done.stderr
    )
    found = read_sensor_signal(rig / "p.mcap", "a", Span(0.0, 2.99), None)
    count = len(found.signal.samples)
    np.testing.assert_array_equal(found.signal.samples, SIGNAL.astype("f4")[:count])
    np.testing.assert_allclose(found.signal.time, TIME[:count], atol=2e-9)
    assert count > 2.98 * RATE and found.unit == "g"


def test_topics_of_a_recording_are_columns(rig):
    """Without a scene, orders are per turn of the shaft of the speed."""
    file, _ = imported(rig, "columns", "speed: {file: slow.csv, column: speed}")
    done = succeed(
        "spectrum", file, "--column", "ring_top", "--speed",
        "planetary_twin/joint_states/velocity_1 [rad/s]", "--order", "--json", "-",
    )  # fmt: skip
    line = json.loads(done.stdout)["lines"][0]
    assert line["order"] == pytest.approx(30.0, abs=0.005)
    assert line["amplitude"] == pytest.approx(50.0, rel=2e-3)


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("sensors: {}", "sensors"),
        ("sensors: {Top: {column: 1}}", "'Top': must be a name of small letters"),
        ("sensors: {a: {column: 7}}", "--column = '7': no such column; columns: channel_1"),
        ("sensors: {a: {}}\nspeed: {column: 1}\ntachometer: {column: 1}", "replaces speed"),
        ("sensors: {a: {}}\ntorques: {sun: {}}", "'sun': must be input or output"),
    ],
)
def test_a_wrong_map_is_refused_in_one_line(rig, text, reason):
    (rig / "wrong.yaml").write_text(text)
    done = invoke("import", rig / "rig.wav", "--sensors", rig / "wrong.yaml", "--out", rig / "none")
    assert done.exit_code == 2 and reason in done.output and done.output.count("\n") == 1
    assert not (rig / "none").exists()
