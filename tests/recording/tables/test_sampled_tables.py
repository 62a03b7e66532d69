"""Exported samples of sensors are those that another reader finds, each once, with units."""

from functools import partial

import numpy as np
import pytest
from command_line import invoke, succeed
from pyarrow import parquet
from sensor_recording import BLOCK, RATE, TOPIC, record_device, record_twin
from twin_recording import START_NS, decoded

export = partial(invoke, "export")
exported = partial(succeed, "export")


def table(file):
    found = parquet.read_table(file)
    units = {field.name: field.metadata[b"unit"].decode() for field in found.schema}
    return {name: found[name].to_numpy() for name in found.column_names}, units


def samples_in(file, topic):
    """Samples of a topic by another reader."""
    return np.concatenate([message.samples for message in decoded(file.parent, topic)])


def test_samples_of_a_twin_have_its_time(tmp_path):
    file = record_twin(tmp_path / "bag", duration=0.1)
    exported(file, "--out", tmp_path / "tables")
    found, units = table(tmp_path / "tables/sensors/ring_top.parquet")
    assert units == {"stamp": "ns", "time": "s", "ring_top": "m/s^2"}
    assert found["ring_top"].tobytes() == samples_in(file, TOPIC).tobytes()
    expected = np.arange(10 * BLOCK) / RATE
    np.testing.assert_allclose(found["time"], expected, atol=2e-9)
    np.testing.assert_allclose(found["stamp"] - START_NS, 1e9 * expected, atol=2)


def test_a_device_alone_has_seconds_from_its_first_sample(tmp_path):
    both = np.random.default_rng(1).standard_normal((3 * BLOCK, 2)).astype(np.float32)
    file = record_device(tmp_path / "rig", both, {"axial": "m/s^2", "radial": "g"})
    exported(file, "--out", tmp_path / "rig.parquet")
    found, units = table(tmp_path / "rig.parquet")
    assert units == {"stamp": "ns", "time": "s", "axial": "m/s^2", "radial": "g"}
    np.testing.assert_array_equal(found["axial"], both[:, 0])
    np.testing.assert_array_equal(found["radial"], both[:, 1])
    assert found["time"][0] == 0.0


def test_lost_and_doubled_blocks_are_named_and_not_written(tmp_path):
    altered = {3: (), 5: (5, 5)}
    both = np.random.default_rng(1).standard_normal((8 * BLOCK, 1)).astype(np.float32)
    file = record_device(tmp_path / "rig", both, {"housing": "g"}, lambda n: altered.get(n, (n,)))
    done = export(file, "--out", tmp_path / "rig.parquet")
    assert "1 block is missing, the first after 0.02 s, between numbers 2 and 4" in done.stderr
    assert "1 block is recorded twice, the first at 0.04 s, number 5" in done.stderr
    found, _ = table(tmp_path / "rig.parquet")
    kept = np.delete(both[:, 0], slice(2 * BLOCK, 3 * BLOCK))
    np.testing.assert_array_equal(found["housing"], kept)
    assert found["time"][2 * BLOCK] == pytest.approx(0.03)
