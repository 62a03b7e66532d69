"""Spectra of a sensor whose blocks of samples are in a recording."""

import json
from functools import partial

import command_line
import numpy as np
import pytest
from sensor_recording import RATE, record_device, record_twin

invoke = partial(command_line.invoke, "spectrum")
succeed = partial(command_line.succeed, "spectrum")
MESH = 500.0  # [Hz] of `paper` at 1000 rpm: 30 teeth, the carrier is held


def analysed(*arguments):
    done = succeed(*arguments, "--json", "-")
    return json.loads(done.stdout), done.stderr


def one_line(*arguments):
    done = invoke(*arguments)
    assert done.exit_code == 2
    assert done.stderr.count("\n") == 1
    return done.stderr


@pytest.fixture(scope="module")
def twin(tmp_path_factory):
    return record_twin(tmp_path_factory.mktemp("twin") / "bag")


def test_the_mesh_line_is_found_and_named(twin):
    found, remarks = analysed(twin, "--sensor", "ring_top")
    (highest, *others) = found["lines"]
    assert highest["amplitude"] == pytest.approx(3.0, rel=1e-3)
    assert highest["frequency_hz"] == pytest.approx(MESH, rel=1e-3)
    assert highest["harmonic"] == 1
    assert all(other["amplitude"] < 0.01 for other in others)
    assert found["quantity"] == "ring_top" and found["mesh"] is None
    assert found["samples"] == RATE and "blocks" not in remarks


def test_orders_follow_the_angles_of_the_twin(twin):
    found, _ = analysed(twin, "--sensor", "ring_top", "--order")
    assert found["lines"][0]["order"] == pytest.approx(30.0, abs=0.05)
    assert found["lines"][0]["amplitude"] == pytest.approx(3.0, rel=2e-3)


def test_an_envelope_has_the_modulation(tmp_path):
    time = np.arange(int(RATE)) / RATE
    samples = (1.0 + 0.5 * np.cos(2 * np.pi * 20 * time)) * np.sin(2 * np.pi * 4000 * time)
    file = record_device(tmp_path / "rig", samples[:, None], {"housing": "g"})
    found, _ = analysed(file, "--sensor", "vibration", "--envelope", "3500:4500")
    # (1 + m cos x)^2 has 2 m at x and m^2/2 at 2 x.
    lines = {round(line["frequency_hz"]): line["amplitude"] for line in found["lines"]}
    assert lines[20] == pytest.approx(1.0, rel=0.01)
    assert lines[40] == pytest.approx(0.125, rel=0.01)


def test_a_lost_block_is_named_and_not_bridged(tmp_path):
    file = record_twin(tmp_path / "bag", lambda number: () if number == 31 else (number,))
    found, remarks = analysed(file, "--sensor", "ring_top")
    assert "1 block is missing, the first after 0.3 s, between numbers 30 and 32" in remarks
    assert "only the longest uniformly sampled segment is analysed" in remarks
    assert found["from_s"] == pytest.approx(0.31, abs=1e-6)
    assert found["lines"][0]["amplitude"] == pytest.approx(3.0, rel=1e-3)


def test_a_clock_that_was_set_is_named(tmp_path):
    # Block 40 has the number of a device that has restarted.
    file = record_twin(tmp_path / "bag", lambda n: (n if n < 40 else n - 39,))
    _, remarks = analysed(file, "--sensor", "ring_top")
    assert "1 block is not next to the one before, the first at 0.39 s" in remarks
    assert "between numbers 39 and 1" in remarks


def test_a_channel_of_several_is_chosen_by_its_name(tmp_path):
    time = np.arange(int(RATE)) / RATE
    both = np.column_stack([np.sin(2 * np.pi * f * time) for f in (300.0, 700.0)])
    file = record_device(tmp_path / "rig", both, {"axial": "m/s^2", "radial": "m/s^2"})
    for channel, frequency in (("axial", 300.0), ("radial", 700.0)):
        found, _ = analysed(file, "--sensor", f"vibration.{channel}")
        assert found["lines"][0]["frequency_hz"] == pytest.approx(frequency, abs=0.1)


def test_a_measured_gearbox_has_its_lines_by_a_scene(tmp_path):
    time = np.arange(int(RATE)) / RATE
    file = record_device(
        tmp_path / "rig", np.sin(2 * np.pi * MESH * time)[:, None], {"housing": "m/s^2"}
    )
    given = "--sensor", "vibration", "--scene", "paper"
    found, _ = analysed(file, *given)
    assert found["lines"][0]["harmonic"] == 1
    found, remarks = analysed(file, *given, "--order")
    assert found["lines"][0]["order"] == pytest.approx(30.0, abs=0.1)
    assert "the speed is assumed to be constant, 16.6667 turns" in remarks


def test_a_run_in_a_file_has_the_sensor_of_its_recording(tmp_path):
    (tmp_path / "sensor.yaml").write_text(
        "base: paper\nsensors: [{name: ring_top, kind: accelerometer}]\n"
    )
    lines = []
    for out in ("run.npz", "run.mcap"):
        options = "--duration", "0.5", "--out", tmp_path / out
        assert command_line.invoke("simulate", tmp_path / "sensor.yaml", *options).exit_code == 0
        found, _ = analysed(tmp_path / out, "--sensor", "ring_top", "--from", "0.1", "--to", "0.4")
        lines.append([(line["harmonic"], line["amplitude"]) for line in found["lines"][:3]])
    (first, second) = lines
    assert first[0][0] is not None
    for (one, height), (other, same) in zip(first, second, strict=True):
        assert one == other and height == pytest.approx(same, rel=1e-3)
    text = one_line(tmp_path / "run.npz", "--sensor", "shaft")
    assert "sensor = 'shaft': must be one of ring_top" in text


def test_what_is_not_there_is_refused(twin, tmp_path):
    assert "sensor = 'other': must be one of ring_top" in one_line(twin, "--sensor", "other")
    text = one_line(twin, "--sensor", "ring_top", "--mesh", "planet_ring_1")
    assert "--sensor: replaces --mesh" in text
    assert "omit --scene" in one_line(twin, "--sensor", "ring_top", "--scene", "paper")
    text = one_line(twin, "--sensor", "ring_top", "--from", "7")
    assert "has no samples from 7 to inf s" in text
    (tmp_path / "x.csv").write_text("time,a\n0,1\n")
    assert "--column selects one" in one_line(tmp_path / "x.csv", "--sensor", "a")
    file = record_device(tmp_path / "rig", np.ones((512, 1)), {"housing": "g"})
    assert "--order: needs --scene" in one_line(file, "--sensor", "vibration", "--order")
