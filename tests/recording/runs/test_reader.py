"""A recording becomes arrays; the valid part of a damaged one is kept, other files are refused."""

import numpy as np
import pytest
from twin_recording import BLOCK, SAMPLE_RATE, START_NS, write_recording

import planetary_twin_py as pt
from planetary_twin_py.recording.container.records import RecordingError
from planetary_twin_py.recording.container.storage import Storage
from planetary_twin_py.recording.runs.reader import read_recording

DURATION = 0.3


@pytest.fixture(scope="module")
def sound(tmp_path_factory):
    file = tmp_path_factory.mktemp("bag") / "bag_0.mcap"
    return write_recording(file, DURATION, storage=Storage(chunk_size=0.064))


def test_arrays_contain_the_written_values(sound):
    recording = read_recording(sound)
    assert recording.remarks == []
    assert recording.namespace == "/planetary_twin"
    assert recording.meshes[::3] == ("sun_planet_1", "planet_ring_1")
    twin = pt.Twin(pt.load_scene("paper"), SAMPLE_RATE, 1e-3)
    windows = [twin.advance(0.01) for _ in range(25)]
    assert np.array_equal(recording.state.time[:25], [window.end for window in windows])
    forces = [window.mesh["mesh_force_mean"] for window in windows]
    assert recording.per_mesh("mesh_force_mean").shape == (30, 6)
    assert np.array_equal(recording.per_mesh("mesh_force_mean")[:25], forces)
    wave = windows[0].waveform
    for name in ("dte", "mesh_force", "friction"):
        written = getattr(wave, name).astype(np.float32)
        assert np.array_equal(getattr(recording.waveform, name)[:BLOCK], written)
    assert recording.operating_point["changed"][1] == "lambda_ratio"


def test_waveform_is_one_gapless_grid_with_ros_time_beside_it(sound):
    wave = read_recording(sound).waveform
    samples = round(DURATION * SAMPLE_RATE)
    assert np.allclose(wave.time, np.arange(1, samples + 1) / SAMPLE_RATE, atol=1e-9)
    assert np.abs(wave.stamp - START_NS - wave.time * 1e9).max() < 10
    assert np.array_equal(wave.block, np.arange(0, samples, BLOCK))


def test_the_namespace_is_found_or_must_exist(tmp_path):
    file = write_recording(tmp_path / "a.mcap", 0.02, namespace="/left/gearbox")
    assert read_recording(file).namespace == "/left/gearbox"
    assert read_recording(file, "left/gearbox").namespace == "/left/gearbox"
    with pytest.raises(RecordingError, match=r"namespace = /right: .* has /left/gearbox"):
        read_recording(file, "right")
    write_recording(tmp_path / "b.mcap", 0.02, namespace="/right")
    with pytest.raises(RecordingError, match="choose --namespace from /left/gearbox, /right"):
        read_recording(tmp_path)


def test_a_file_that_is_no_recording_is_named_in_one_line(tmp_path):
    text = tmp_path / "notes.txt"
    text.write_text("not a recording")
    empty = tmp_path / "empty"
    empty.mkdir()
    bare = write_recording(tmp_path / "bare.mcap", 0.0)
    for path, reason in [
        (tmp_path / "missing.mcap", "no such file"),
        (text, "not an MCAP file"),
        (empty, "has no .mcap file"),
        (bare, "no gearbox_state message"),
    ]:
        with pytest.raises(RecordingError, match=reason) as caught:
            read_recording(path)
        assert "\n" not in str(caught.value)


def test_samples_of_a_span_are_those_of_its_blocks(sound):
    recording = read_recording(sound)
    whole = recording.waveform
    part = recording.samples(0.105, 0.12)
    first = np.searchsorted(whole.time, part.time[0])
    rows = slice(first, first + len(part.time))
    assert part.time[0] == pytest.approx(0.10002) and part.time[-1] == pytest.approx(0.12)
    for name in ("time", "stamp", "dte", "mesh_force", "friction"):
        assert np.array_equal(getattr(part, name), getattr(whole, name)[rows])
    assert recording.samples(5.0, 6.0) is None


def test_ranges_are_those_of_the_samples(sound):
    recording = read_recording(sound)
    whole, ranges = recording.waveform, recording.ranges
    assert np.array_equal(ranges.time, whole.time[whole.block])
    assert np.array_equal(ranges.stamp, whole.stamp[whole.block])
    for name in ("dte", "mesh_force", "friction"):
        samples = getattr(whole, name)
        assert np.array_equal(ranges.lowest[name], np.fmin.reduceat(samples, whole.block))
        assert np.array_equal(ranges.highest[name], np.fmax.reduceat(samples, whole.block))


def test_reading_stops_after_the_most_states(sound):
    """Chunks of 64 kB hold four intervals."""
    first = read_recording(sound, most=8)
    assert not first.complete
    assert 8 <= len(first.state) <= 14
    assert first.state.time[0] == pytest.approx(0.01)
    part = read_recording(sound, most=14, span=(0.105, 0.2))
    assert part.complete
    assert part.state.time == pytest.approx(np.arange(11, 21) * 0.01)
    assert part.waveform.time[[0, -1]] == pytest.approx([0.10002, 0.2])  # whole blocks
    assert len(part.operating_point) == 2 and len(first.operating_point) == 1
    with pytest.raises(RecordingError, match="has no state from 5 to 6 s"):
        read_recording(sound, span=(5.0, 6.0))
