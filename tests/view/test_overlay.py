"""Several recordings in one view, and their differences."""

import copy
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from rerun.chunk import RrdReader
from twin_recording import write_recording

from planetary_twin_py.recording.container.records import RecordingError
from planetary_twin_py.recording.runs.reader import read_recording
from planetary_twin_py.view.overlay import difference, names_of
from planetary_twin_py.view.show import save


@pytest.fixture(scope="module")
def first(tmp_path_factory):
    return read_recording(write_recording(tmp_path_factory.mktemp("a") / "first.mcap", 0.1))


def altered(recording, name="other", start=0.0, more=1e-6):
    """A branch of `recording` from `start` [s] on, with a larger DTE."""
    other = copy.deepcopy(recording)
    other.path = Path(name)
    wave = other.waveform
    rows = wave.time >= start
    other.waveform = replace(
        wave,
        time=wave.time[rows] * (1.0 + 1e-12),  # as another order of summation gives
        stamp=wave.stamp[rows],
        block=np.unique(np.maximum(wave.block - np.argmax(rows), 0)),
        dte=wave.dte[rows] + np.float32(more),
        mesh_force=wave.mesh_force[rows],
        friction=wave.friction[rows],
    )
    return other


def entities(rrd):
    """Paths in a Rerun file, with the names of their lines."""
    found = {}
    for chunk in RrdReader(rrd).stream():
        names = found.setdefault(chunk.entity_path, [])
        batch = chunk.to_record_batch()
        if "SeriesLines:names" in batch.schema.names:
            names += batch.column("SeriesLines:names").to_pylist()[0]
    return found


def test_a_difference_is_that_of_samples_at_one_instant(first):
    other = altered(first, start=0.05)
    less = difference(first, other).waveform
    assert np.array_equal(less.time, other.waveform.time)
    assert np.allclose(less.dte, 1e-6, rtol=1e-4)
    assert np.all(less.mesh_force == 0.0)
    assert np.array_equal(less.block, other.waveform.block)


def test_samples_at_other_instants_have_no_difference(first):
    other = altered(first)
    other.waveform.time[: len(other.waveform.time) // 2] += 1e-5
    less = difference(first, other).waveform
    assert np.array_equal(less.time, other.waveform.time[len(other.waveform.time) // 2 :])
    assert less.block[0] == 0
    other.waveform.time[:] += 3e-6
    with pytest.raises(RecordingError, match="no sample has the same time"):
        difference(first, other)


def test_recordings_are_named_by_their_differences(first):
    assert names_of([first]) == [""]
    assert names_of([first, altered(first, "b/other.mcap")]) == ["first", "other"]
    same = altered(first, "b/first.mcap")
    assert names_of([first, same]) == [str(first.path), "b/first.mcap"]
    with pytest.raises(RecordingError, match="given twice"):
        names_of([first, first])


def test_every_plot_shows_all_recordings_and_names_them(first, tmp_path):
    assert save(first, None, tmp_path / "a.rrd") == []
    alone = entities(tmp_path / "a.rrd")
    assert save(first, None, tmp_path / "b.rrd", [altered(first)]) == []
    both = entities(tmp_path / "b.rrd")
    plots = {path for path in alone if path.split("/")[1] in ("mesh", "train", "range", "waveform")}
    assert plots
    assert {f"{path}/other" for path in plots} <= both.keys()
    assert alone["/mesh/dte_mean"][0] == "sun_planet_1"
    assert both["/mesh/dte_mean"][0] == "first: sun_planet_1"
    assert both["/mesh/dte_mean/other"][0] == "other: sun_planet_1"
    assert {"/difference/waveform/dte", "/difference/range/mesh_force"} <= both.keys()


def test_other_numbers_of_planets_are_shown_without_a_difference(first, tmp_path):
    other = altered(first)
    other.planets = 2
    wave = other.waveform
    wave.dte, wave.mesh_force, wave.friction = wave.dte[:, :4], wave.mesh_force[:, :4], None
    (remark,) = save(first, None, tmp_path / "a.rrd", [other])
    assert "has 2 planets" in remark
    assert "/mesh/dte_mean/other" in entities(tmp_path / "a.rrd")
