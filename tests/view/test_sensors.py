"""Sensors in a view: samples, ranges and spectra with named lines."""

import numpy as np
import pytest
from sensor_recording import BLOCK, RATE, record_twin
from view.entity_rows import rows

from planetary_twin_py.recording.runs.reader import read_recording
from planetary_twin_py.scene import load_scene
from planetary_twin_py.view.show import save

PATH = "/sensors/ring_top"


def lost(number):
    return () if number == 150 else (number,)


@pytest.fixture(scope="module")
def recording(tmp_path_factory):
    return read_recording(record_twin(tmp_path_factory.mktemp("twin") / "bag", lost, duration=2.0))


@pytest.fixture(scope="module")
def saved(recording, tmp_path_factory):
    """Path of the Rerun file, and its warnings."""
    rrd = tmp_path_factory.mktemp("drawn") / "drawn.rrd"
    return rrd, save(recording, load_scene("paper"), rrd)


def test_every_sample_is_in_the_file(recording, saved):
    (sensor,) = recording.sampled.values()
    found = sensor.samples(recording.to_time, -np.inf, np.inf)
    drawn = rows(saved[0], f"{PATH}/waveform")
    assert len(drawn) == len(found.time) == 199 * BLOCK
    time, values = zip(*drawn, strict=True)
    np.testing.assert_allclose(np.ravel(values), found.values[:, 0], rtol=1e-6)
    np.testing.assert_allclose(time, found.time, atol=2e-9)


def test_ranges_contain_the_samples_of_each_block(saved):
    ranges = np.array([value for _, value in rows(saved[0], f"{PATH}/range")])
    assert len(ranges) == 199
    assert (ranges[:, 0] < -2.9).all() and (ranges[:, 1] > 2.9).all()


def test_a_lost_block_is_a_gap_that_is_stated(saved):
    rrd, remarks = saved
    (remark,) = [line for line in remarks if "missing, the first" in line]
    assert "sensors/ring_top: 1 block is missing, the first after 1.49 s" in remark
    time = np.array([at for at, _ in rows(rrd, f"{PATH}/waveform")])
    steps = np.diff(time)
    assert steps.max() == pytest.approx((BLOCK + 1) / RATE, abs=1e-8)
    assert np.sort(steps)[-2] < 1.01 / RATE


def test_spectra_have_lines_with_their_causes(saved):
    rrd = saved[0]
    for kind in ("spectrum", "order_spectrum"):
        labels = rows(rrd, f"{PATH}/{kind}/names", "Points2D:labels")
        assert labels and all("mesh harmonic 1" in texts for _, texts in labels)
        curves = rows(rrd, f"{PATH}/{kind}/curve", "LineStrips2D:strips")
        assert len(curves) == len(labels)
    assert rows(rrd, f"{PATH}/envelope_spectrum/curve", "LineStrips2D:strips")


def test_spectra_of_the_same_sensor_in_two_recordings_are_beside_each_other(recording, tmp_path):
    measured = read_recording(record_twin(tmp_path / "measured", duration=1.5))
    remarks = save(recording, load_scene("paper"), tmp_path / "both.rrd", [measured])
    assert not [line for line in remarks if "spectra" in line]
    for kind in ("spectrum", "order_spectrum", "envelope_spectrum"):
        path = f"{PATH}/{kind}/curve"
        ours, theirs = (
            rows(tmp_path / "both.rrd", place, "LineStrips2D:strips")
            for place in (path, f"{path}/measured_0")
        )
        assert len(ours) == len(theirs) == 3
    # the same tone in the same frame: the curves coincide
    one, other = (
        rows(tmp_path / "both.rrd", f"{PATH}/order_spectrum/curve{name}", "LineStrips2D:strips")
        for name in ("", "/measured_0")
    )
    np.testing.assert_allclose(one[0][1], other[0][1], atol=2.0)  # pixels


def test_spectra_of_another_unit_are_not_drawn_in_the_same_frame(recording, tmp_path):
    measured = read_recording(record_twin(tmp_path / "measured", unit="g"))
    remarks = save(recording, load_scene("paper"), tmp_path / "both.rrd", [measured])
    (said,) = [line for line in remarks if "spectra" in line]
    assert "ring_top is in g, not in m/s^2" in said
