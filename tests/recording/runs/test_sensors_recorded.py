"""Sensors in recordings: their messages, `verify`, `resimulate`, and files of arrays."""

from pathlib import Path

import numpy as np
import pytest
from twin_recording import NAMESPACE, START_NS, Alter, Row, TwinRecording, as_it_is, without

import planetary_twin_py as pt
from planetary_twin_py.recording.ros2.sensor_messages import kinds_of
from planetary_twin_py.recording.runs.branch import Branch
from planetary_twin_py.recording.runs.offline import Plan, record
from planetary_twin_py.recording.runs.schedule import messages_of
from planetary_twin_py.recording.runs.verify import verify
from planetary_twin_py.recording.runs.what_if import resimulate
from planetary_twin_py.recording.tables.result_files import write_npz

SCENE = pt.load_scene("paper").replace(
    sensors=[
        {"name": "top", "kind": "accelerometer", "range": 500.0},
        {"name": "encoder", "kind": "encoder", "shaft": "output", "bits": 16},
        {"name": "key", "kind": "tachometer", "shaft": "input"},
        {"name": "oil", "kind": "thermometer", "rate": 20.0},
    ]
)
WINDOWS = 40  # of 10 ms, each of two runs


def recorded(folder: Path, alter: Alter = as_it_is) -> Path:
    """Two runs with changes of the operating point and a waveform that is thinned."""
    recording = TwinRecording(folder, alter, sensors=kinds_of(SCENE))
    for run in range(2):
        twin = pt.Twin(SCENE, 20_000.0, 1e-3)
        recording.begin(twin, START_NS + run * 10**9)
        for number in range(1, WINDOWS + 1):
            recording.advance(twin, 0.01)
            if number == 15:
                twin.set(lambda_ratio=1.5, oil_temperature=340.0)
                recording.point(twin)
            if number in (20, 30):
                twin.set_sample_rate({20: 2500.0, 30: 20_000.0}[number])
                twin.set_tolerance({20: 1e-2, 30: 1e-3}[number])
    recording.finish()
    return recording.file


def of_topic(file: Path, topic: str) -> list:
    return [message for _, message in messages_of(file, NAMESPACE, (topic,), [])]


def test_recorded_sensors_are_verified_bit_for_bit(tmp_path: Path) -> None:
    file = recorded(tmp_path / "bag")
    found = verify(file, NAMESPACE)
    assert found.identical and not found.left_out, list(found.lines())
    topics = {topic: n for topic, n in found.messages.items() if topic.startswith("sensors/")}
    assert topics == {
        topic: len(of_topic(file, topic))
        for topic in ("sensors/top", "sensors/top/levels", *(f"sensors/{n}" for n in (
            "encoder", "key", "oil"
        )))
    }  # fmt: skip
    assert min(topics.values()) >= 4


@pytest.mark.parametrize(
    ("topic", "field"),
    [
        ("sensors/top", "samples"),
        ("sensors/top/levels", "rms"),
        ("sensors/encoder", "output_counts"),
        ("sensors/key", "times"),
        ("sensors/oil", "temperature"),
    ],
)
def test_an_altered_reading_is_found(topic: str, field: str, tmp_path: Path) -> None:
    """The smallest change of a value of the third message."""

    def altered(at: str, number: int, row: Row) -> Row:
        if (at, number) != (topic, 3):
            return row
        values = np.atleast_1d(row[field]).copy()
        step = 1 if values.dtype.kind == "i" else np.spacing(values[0])
        values[0] += step
        return row | {field: values if np.ndim(row[field]) else float(values[0])}

    first = verify(recorded(tmp_path / "bag", altered), NAMESPACE).first_difference
    assert first is not None and (first.topic, first.field, first.place) == (topic, field, 0)


@pytest.mark.parametrize("topic", ["sensors/top", "sensors/oil", "sensors/encoder"])
@pytest.mark.parametrize("numbers", [{1}, {3, 4, 9}])
def test_lost_messages_of_a_sensor_leave_the_others_verified(
    topic: str, numbers: set[int], tmp_path: Path
) -> None:
    found = verify(recorded(tmp_path / "bag", without(topic, numbers)), NAMESPACE)
    assert found.first_difference is None and not found.left_out, list(found.lines())


def test_resimulated_sensors_are_those_of_the_recording(tmp_path: Path) -> None:
    """Until the branch bit for bit; then they differ, and the new recording verifies, too."""
    file = recorded(tmp_path / "bag")
    branch = Branch({"input_torque": 30.0}, start=0.2)
    made = resimulate(file, NAMESPACE, branch, tmp_path / "new")
    found = verify(made.file, NAMESPACE)
    assert found.identical and found.messages["sensors/top"] > 4
    before, after = (
        np.concatenate([message.samples for message in of_topic(each, "sensors/top")])
        for each in (file, made.file)
    )
    before = before[len(before) // 2 :]  # of the last run
    assert len(before) == len(after)
    same = np.flatnonzero(before != after)[0]
    assert 0.19 < same / 25_600.0 < 0.2


def test_recorded_samples_are_those_of_the_run(tmp_path: Path) -> None:
    """Values, number and time: `simulate --out` of both kinds has the same readings."""
    file = record(Plan(SCENE, 0.2, 5000.0, 1e-4, 0.1), tmp_path / "bag")
    assert verify(file, NAMESPACE).identical
    result = pt.simulate(SCENE, 0.2, 5000.0, settling=0.1)
    arrays = tmp_path / "run.npz"
    write_npz(result, SCENE, arrays)
    with np.load(arrays) as kept:
        for name, readings in result.sensors.items():
            assert np.array_equal(kept[f"sensors.{name}.values"], readings.values)
            assert np.array_equal(kept[f"sensors.{name}.time"], readings.time)
    top = np.concatenate([message.samples for message in of_topic(file, "sensors/top")])
    values = result.sensors["top"].values.astype(np.float32)
    begin = pt.Twin(SCENE).advance(0.02).sensors["top"].first  # filters are filled before
    skipped = round((result.sensors["top"].first - begin) * 25_600)
    assert np.array_equal(top[skipped:], values[: len(top) - skipped])
    blocks = of_topic(file, "sensors/encoder")
    counts = np.concatenate([block.output_counts for block in blocks])
    encoder = result.sensors["encoder"]
    skipped = round(encoder.first * 25_600) - blocks[0].first_sample
    assert np.array_equal(counts[skipped:], encoder.values[: len(counts) - skipped])
    pulses = np.concatenate([block.times for block in of_topic(file, "sensors/key")])
    key = result.sensors["key"]
    assert np.isin(pulses[pulses > 0.1], key.values).all() and len(pulses) > 3


def test_a_recorder_that_stops_before_a_state_leaves_no_warning(tmp_path: Path) -> None:
    """The last messages of the sensors are of an interval whose state is not recorded."""
    late = {2 * WINDOWS - 1, 2 * WINDOWS}
    found = verify(recorded(tmp_path / "bag", without("gearbox_state", late)), NAMESPACE)
    assert found.identical and not found.left_out, list(found.lines())
