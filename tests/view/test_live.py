"""A live view draws what the recording of the run shows."""

import itertools

import numpy as np
import pytest
from mcap.records import Message
from rerun.chunk import RrdReader
from sensor_recording import record_twin
from tiers import first
from twin_recording import record

from planetary_twin_py.recording.container.records import records_of
from planetary_twin_py.recording.runs.reader import read_recording
from planetary_twin_py.view.live import LiveView
from planetary_twin_py.view.show import save, scene_of, to_file

NAMESPACE = "/planetary_twin"


@pytest.fixture(scope="module")
def file(tmp_path_factory):
    """Two runs: 0.3001 s with changes during the run, then 0.1 s."""
    return record(tmp_path_factory.mktemp("bag") / "runs")


def drawn(file, folder, batch):
    """Rerun files of the runs in `file`, drawn in batches of so many messages."""
    files = []

    def begin():
        files.append(folder / f"{len(files)}.rrd")
        return to_file(files[-1])

    view = LiveView(NAMESPACE, begin)
    records = list(records_of(file, []))
    messages = [place for place, record in enumerate(records) if isinstance(record, Message)]
    edges = [0, *messages[::batch], len(records)]
    for start, end in itertools.pairwise(edges):
        view.add(records[start:end])
    view.close()
    return files


def columns(rrd, component):
    """Simulated times [ns] and rows of a component, by entity."""
    found = {}
    for chunk in RrdReader(rrd).stream():
        batch = chunk.to_record_batch()
        if component in batch.schema.names and not chunk.is_static:
            times = batch.column("simulated_time").cast("int64").to_pylist()
            rows = batch.column(component).to_pylist()
            found.setdefault(chunk.entity_path, []).extend(zip(times, rows, strict=True))
    return found


@pytest.mark.parametrize("batch", first(1, [1, 7, 10_000]))
def test_batches_of_any_size_draw_the_curves_of_the_recording(file, tmp_path, batch):
    runs = drawn(file, tmp_path, batch)
    assert len(runs) == 2
    live = [columns(rrd, "Scalars:scalars") for rrd in runs]
    recording = read_recording(file)
    save(recording, scene_of(recording)[0], tmp_path / "all.rrd")
    whole = columns(tmp_path / "all.rrd", "Scalars:scalars")
    assert whole.keys() == live[0].keys() == live[1].keys()
    for path, rows in whole.items():
        if not path.startswith("/operating_point"):  # which is logged up to the end of each batch
            for shown, recorded in zip(live[0][path] + live[1][path], rows, strict=True):
                assert shown[0] == recorded[0], path
                np.testing.assert_array_equal(shown[1], recorded[1], path)


@pytest.mark.parametrize("batch", first(1, [1, 7]))
def test_gears_turn_and_changes_are_logged_once(file, tmp_path, batch):
    first, second = drawn(file, tmp_path, batch)
    for rrd, seconds in ((first, 0.3001), (second, 0.1)):
        sun = columns(rrd, "Transform3D:quaternion")["/gears/sun"]
        assert sun[-1][0] == pytest.approx(seconds * 1e9)
        assert np.diff([time for time, _ in sun]).max() < 1e9 / 500.0 / 5.0
        static = {chunk.entity_path for chunk in RrdReader(rrd).stream() if chunk.is_static}
        assert "/gears/carrier/pin_3/planet_3" in static
    changes = [text for _, (text,) in columns(first, "TextLog:text")["/changes"]]
    assert len(changes) == 2


def test_samples_of_a_sensor_are_drawn_as_they_arrive(tmp_path):
    file = record_twin(tmp_path / "bag", duration=0.2)
    (live,) = drawn(file, tmp_path, 25)
    found = columns(live, "Scalars:scalars")["/sensors/ring_top/waveform"]
    recording = read_recording(file)
    (sensor,) = recording.sampled.values()
    expected = sensor.samples(recording.to_time, -np.inf, np.inf)
    times, values = zip(*found, strict=True)
    np.testing.assert_allclose(np.ravel(values), expected.values[:, 0], rtol=1e-6)
    np.testing.assert_allclose(1e-9 * np.array(times), expected.time, atol=2e-9)
    assert len(columns(live, "Scalars:scalars")["/sensors/ring_top/range"]) == 20
