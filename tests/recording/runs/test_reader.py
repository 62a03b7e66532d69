"""A recording becomes arrays; the valid part of a damaged one is kept, other files are refused."""

import numpy as np
import pytest
from synthetic_recording import BLOCK, SAMPLE_PERIOD, START_NS, state, waveform, write_recording

from planetary_twin_py.recording.container.records import RecordingError
from planetary_twin_py.recording.runs.reader import read_recording

DURATION = 0.3


@pytest.fixture(scope="module")
def sound(tmp_path_factory):
    return write_recording(tmp_path_factory.mktemp("bag") / "bag_0.mcap", DURATION)


def test_arrays_contain_the_written_values(sound):
    recording = read_recording(sound)
    assert recording.remarks == []
    assert recording.namespace == "/planetary_twin"
    assert recording.meshes[::3] == ("sun_planet_1", "planet_ring_1")
    rows = [state(0.01 * (k + 1), 0.01, k + 1) for k in range(30)]
    assert np.allclose(recording.state.time, [row["simulated_time"] for row in rows])
    assert np.allclose(recording.state["ring_angle"], [row["ring_angle"] for row in rows])
    assert recording.per_mesh("dte_mean").shape == (30, 6)
    assert np.isfinite(recording.per_mesh("dte_mean")).all()
    assert list(recording.operating_point["changed"]) == [
        "",
        "lambda_ratio",
        "backlash",
        "lambda_ratio,input_speed",
    ]


def test_waveform_is_one_gapless_grid_with_ros_time_beside_it(sound):
    wave = read_recording(sound).waveform
    samples = round(DURATION / SAMPLE_PERIOD)
    assert np.allclose(wave.time, SAMPLE_PERIOD * np.arange(1, samples + 1), atol=1e-9)
    assert np.abs(wave.stamp - START_NS - wave.time * 1e9).max() < 10
    assert np.array_equal(wave.block, np.arange(0, samples, BLOCK))
    dte, force, friction = waveform(SAMPLE_PERIOD * np.arange(1, BLOCK + 1))
    assert np.allclose(wave.dte[:BLOCK], dte, rtol=1e-6)
    assert np.allclose(wave.mesh_force[:BLOCK], force, rtol=1e-6)
    assert np.allclose(wave.friction[:BLOCK], friction, rtol=1e-6)


def test_an_unfinished_file_lacks_only_the_open_chunk(tmp_path):
    truncated = write_recording(tmp_path / "truncated.mcap", DURATION, finish=False)
    recording = read_recording(truncated)
    assert 20 <= len(recording.state) < 30
    assert np.allclose(recording.state.time, 0.01 * np.arange(1, len(recording.state) + 1))


@pytest.mark.parametrize("share", [0.3, 0.5, 0.77, 0.999])
def test_a_file_cut_anywhere_opens_with_what_is_before_the_cut(sound, tmp_path, share):
    whole = sound.read_bytes()
    truncated = tmp_path / "truncated.mcap"
    truncated.write_bytes(whole[: int(share * len(whole))])
    recording = read_recording(truncated)
    count = len(recording.state)
    assert 0 < count <= 30
    assert np.array_equal(recording.state.time, read_recording(sound).state.time[:count])
    assert len(recording.remarks) == 1
    assert "unreadable" in recording.remarks[0]
    assert "\n" not in recording.remarks[0]


def test_the_folder_of_a_bag_can_be_opened_like_its_file(sound):
    assert len(read_recording(sound.parent).state) == len(read_recording(sound).state)


def test_the_scene_is_stored_in_the_recording(tmp_path):
    file = write_recording(tmp_path / "a.mcap", 0.02, scene_yaml="name: x\n")
    assert read_recording(file).scene_yaml == "name: x\n"


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


def test_reading_stops_after_the_most_states(tmp_path):
    """Chunks of 64 kB hold four intervals."""
    file = write_recording(tmp_path / "bag_0.mcap", DURATION)
    first = read_recording(file, most=8)
    assert not first.complete
    assert 8 <= len(first.state) <= 14
    assert first.state.time[0] == pytest.approx(0.01)
    part = read_recording(file, most=14, span=(0.105, 0.2))
    assert part.complete
    assert part.state.time == pytest.approx(np.arange(11, 21) * 0.01)
    assert part.waveform.time[[0, -1]] == pytest.approx([0.10002, 0.2])  # whole blocks
    assert len(part.operating_point) == len(first.operating_point) == 4
    with pytest.raises(RecordingError, match="has no state from 5 to 6 s"):
        read_recording(file, span=(5.0, 6.0))
