"""Views of windows of the DTE: spectrum, order map and phase portrait."""

from unittest.mock import Mock

import numpy as np
import pytest
from twin_recording import BLOCK
from view.entity_rows import rerun

from planetary_twin_py.recording.runs.reader import read_recording
from planetary_twin_py.scene import load_scene
from planetary_twin_py.view.chart import Chart
from planetary_twin_py.view.frames import frames
from planetary_twin_py.view.phase_portrait import SIZE, _on_axis, _portrait, flanks_meet
from planetary_twin_py.view.show import save
from planetary_twin_py.view.spectra import ROWS, _orders, _spectrum


@pytest.fixture
def recording(tour):
    return read_recording(tour)


def test_the_file_contains_spectrum_order_map_and_phase_portrait(recording, tmp_path):
    assert save(recording, load_scene("paper"), tmp_path / "a.rrd") == []
    printed = rerun("print", tmp_path / "a.rrd")
    for entity in (
        "/spectrum/dte",
        "/spectrum/mesh_harmonics",
        "/order_map/picture",
        "/order_map/cursor",
        "/phase_portrait/curve",
        "/phase_portrait/range",
    ):
        assert entity in printed


def test_the_spectrum_has_the_lines_of_its_instant(recording):
    """500 Hz at 1000 rpm; from 0.75 s on 1000 Hz at 2000 rpm."""
    windows = frames(recording)
    for at, mesh in ((0.1, 500.0), (0.9, 1000.0)):
        frequency, amplitude = _spectrum(windows, int(np.abs(windows.time - at).argmin()))
        assert frequency[1 + amplitude[1:].argmax()] == pytest.approx(mesh, abs=5.0)


def test_the_order_map_keeps_the_meshing_at_its_order(recording):
    windows, reach = frames(recording), 8.5 * 30
    for at in (0.1, 0.9):
        levels = _orders(windows, int(np.abs(windows.time - at).argmin()), reach)
        assert levels.argmax() == pytest.approx(30 / reach * ROWS, abs=1.0)


def test_windows_near_a_gap_are_shifted_and_none_spans_it(recording):
    wave = recording.waveform
    kept = np.r_[0 : 45 * BLOCK, 55 * BLOCK : 58 * BLOCK, 60 * BLOCK : 100 * BLOCK]
    wave.time, wave.stamp, wave.dte = wave.time[kept], wave.stamp[kept], wave.dte[kept]
    windows = frames(recording)
    for number, now in enumerate(windows.time):
        found = windows.window(number, 0.2)
        if 0.4501 < now < 0.599:
            assert found is None
        else:
            moments, dte = found
            assert moments[-1] - moments[0] == pytest.approx(0.2, abs=4e-5)
            assert np.diff(moments).max() < 2.1e-5
            assert moments[0] - 2.1e-5 < now < moments[-1] + 2.1e-5
            assert np.isfinite(dte).all()


def test_a_reduced_sample_rate_is_reported(recording):
    assert frames(recording).remark is None
    wave = recording.waveform
    kept = np.r_[0 : 50 * BLOCK, 50 * BLOCK : 100 * BLOCK : 8]
    wave.time, wave.stamp, wave.dte = wave.time[kept], wave.stamp[kept], wave.dte[kept]
    assert (
        "reduced in places, from 50000 to 6250 Hz: components above 3125 Hz"
        in frames(recording).remark
    )


def test_without_samples_there_is_nothing_to_show(recording):
    recording.waveform = None
    assert frames(recording) is None


@pytest.mark.parametrize(("law", "share"), [("dead_zone", 0.5), ("regulatory_factor", 1.0)])
def test_marks_of_the_portrait_are_where_flanks_meet(law, share):
    scene = load_scene("paper").replace(**{"mesh.backlash": law, "mesh.motion": "line_of_action"})
    assert flanks_meet(scene, 4e-5) == share * 4e-5


def test_a_curve_is_placed_on_the_axes_of_its_picture():
    chart = Chart("spectrum", (400, 300), yscale="log", xlim=(0.0, 10.0), ylim=(1e-3, 10.0))
    chart.log(Mock())
    frame = chart.axes.bbox
    corners = np.array([[frame.x0, 600 - frame.y0], [frame.x1, 600 - frame.y1]])
    assert chart.place([0.0, 10.0], [1e-3, 10.0]) == pytest.approx(corners, abs=0.01)
    assert chart.place([-1.0, 11.0], [0.0, 99.0]) == pytest.approx(corners, abs=0.01)
    assert chart.place([5.0], [0.1])[0] == pytest.approx(corners.mean(axis=0), abs=0.01)


def test_a_portrait_fills_its_axes(recording):
    windows = frames(recording)
    chart = Chart("phase_portrait", SIZE)
    drawn = _portrait(chart, windows, 3, 0.0)
    x = np.linspace(2.0, 4.0, 11)
    assert _on_axis(x, x)[[0, -1]] == pytest.approx([0.06 / 1.12, 1.06 / 1.12])
    assert len(drawn.curve) == len(drawn.ranges) == 1
