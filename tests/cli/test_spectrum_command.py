"""The command `spectrum` as typed."""

import json

import numpy as np
import pytest
from command_line import run_here, succeed
from PIL import Image
from twin_recording import BLOCK, SAMPLE_RATE, START_NS, TwinRecording, write_recording

import planetary_twin_py as pt
from planetary_twin_py.analysis.signals.signal import of_recording
from planetary_twin_py.recording.runs.reader import read_recording

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def file(tmp_path_factory):
    path = tmp_path_factory.mktemp("bag") / "one.mcap"
    return write_recording(path, 1.0)


@pytest.mark.parametrize(("options", "axis"), [([], "frequency_hz"), (["--order"], "order")])
def test_lines_are_named_as_harmonics_of_the_meshing(file, options, axis):
    """The DTE repeats with the meshing: 500 Hz at 1000 rpm, order 30 of the sun."""
    done = succeed("spectrum", file, *options, "--to", 0.24, "--json", "-")
    figures = json.loads(done.stdout)
    first = {"frequency_hz": 500.0, "order": 30.0}[axis]
    for line in figures["lines"]:
        assert line["harmonic"] == round(line[axis] / first)
        assert line[axis] == pytest.approx(line["harmonic"] * first, rel=2e-3)
    assert "mesh harmonic 1" in done.stderr


def test_the_longest_time_at_one_operating_point_is_analysed(tmp_path):
    recording, twin = TwinRecording(tmp_path / "bag"), pt.Twin(pt.load_scene("paper"))
    recording.begin(twin, START_NS)
    for _ in range(6):
        recording.advance(twin, 0.01)
    twin.set(input_speed=pt.rpm(1030.0))
    recording.point(twin)
    for _ in range(160):
        recording.advance(twin, 0.01)
    recording.finish()
    file = tmp_path / "bag"
    done = run_here("spectrum", file, "--json", "-")
    figures = json.loads(done.stdout)
    assert 1.0 < figures["from_s"] < 1.5 and figures["to_s"] == pytest.approx(1.66, abs=1e-3)
    assert figures["lines"][0]["frequency_hz"] == pytest.approx(515.0, rel=1e-3)
    assert "Hz, mean" in done.stderr and "one operating point" not in done.stderr


def test_a_picture_and_a_table_are_written(file, tmp_path):
    for name in ("a.png", "a.csv"):
        succeed(
            "spectrum", file, "--mesh", "planet_ring_2", "--quantity", "mesh_force",
            "--from", 0.3, "--out", tmp_path / name,
        )  # fmt: skip
    assert Image.open(tmp_path / "a.png").size[0] == 800
    table = np.genfromtxt(tmp_path / "a.csv", delimiter=",", names=True)
    assert table.dtype.names == ("frequency_Hz", "amplitude_of_mesh_force_N")
    assert table["amplitude_of_mesh_force_N"][0] == pytest.approx(63.0 / 0.0111772 / 3, rel=0.02)


@pytest.mark.exhaustive
@pytest.mark.parametrize(("faulty", "low", "high"), [(True, 1e-9, 1e-8), (False, 0.0, 1e-11)])
def test_a_cracked_tooth_of_the_sun_has_sidebands_at_its_turns(tmp_path, faulty, low, high):
    """A band around the first harmonic of the meshing, 30 orders of the sun."""
    npz, healthy = tmp_path / "run.npz", tmp_path / "healthy.yaml"
    healthy.write_text("base: cracked_tooth\nname: healthy\nfaults: []\n")
    scene = "cracked_tooth" if faulty else healthy
    run_here("simulate", scene, "--duration", 0.6, "--out", npz)
    done = succeed("spectrum", npz, "--order", "--band", "28.5:31.5", "--json", "-")
    lines = json.loads(done.stdout)["lines"]
    assert lines[0]["harmonic"] == 1 and all(28.5 <= line["order"] <= 31.5 for line in lines)
    for place in (29.0, 31.0):
        near = [line["amplitude"] for line in lines if abs(line["order"] - place) < 0.05]
        assert low <= max(near, default=0.0) < high
    assert "dte of sun_planet_1, from" in done.stderr


def test_lost_blocks_leave_the_longest_segment_and_are_reported(file):
    recording = read_recording(file)
    wave = recording.waveform
    lost = np.r_[0 : 20 * BLOCK, 25 * BLOCK : 70 * BLOCK]
    wave.time, wave.dte = wave.time[lost], wave.dte[lost]
    signal = of_recording(recording, "sun_planet_1", "dte").within(0.1, None)
    assert len(signal.samples) == 45 * BLOCK
    assert signal.sample_rate == pytest.approx(SAMPLE_RATE)
    assert "samples are missing" in signal.remarks[-1]
