"""A long recording has an overview of the whole, and details where something happens."""

import numpy as np
import pytest
from twin_recording import SAMPLE_RATE, TOUR

from planetary_twin_py.recording.runs.reader import read_recording
from planetary_twin_py.view import detail, waveform


@pytest.fixture(scope="module")
def recording(tour):
    return read_recording(tour)


def test_samples_are_used_for_the_start_and_for_changes(recording, monkeypatch):
    monkeypatch.setattr(detail, "MOST_SAMPLES", 20_000)
    found = detail.detailed_spans(recording)
    assert [begin <= time < end for (begin, end), time in zip(found, (0.0, *TOUR), strict=True)]
    assert found[1] == pytest.approx((0.24, 0.35))
    assert sum(end - begin for begin, end in found) <= 1.1 * 20_000 / SAMPLE_RATE
    monkeypatch.setattr(detail, "MOST_SAMPLES", 12_500)  # of 0.1 s there is room for two
    assert [begin for begin, _ in detail.detailed_spans(recording)] == pytest.approx([0.0, 0.2375])


def test_an_overview_keeps_peaks_and_means(recording, monkeypatch):
    monkeypatch.setattr(detail, "MOST_ROWS", 10)
    state = recording.state
    state["sun_planet_dte_peak"][57] = 1.0
    state["sun_planet_film_thickness"][50:60] = np.nan
    seen = detail.overview(recording, [(0.205, 0.3)]).state
    assert np.array_equal(seen.time[1:12], [0.2, *state.time[20:30]])
    assert len(seen) == 19
    assert seen.time[-1] == state.time[-1] and seen.stamp[-1] == state.stamp[-1]
    assert np.nanmax(seen["sun_planet_dte_peak"]) == 1.0
    assert np.isnan(seen["sun_planet_film_thickness"][14]).all()
    assert np.isfinite(seen["sun_planet_film_thickness"][13, :3]).all()
    assert seen["power_loss"][0] == pytest.approx(state["power_loss"][:10].mean())
    assert seen["sun_angle"][0] == state["sun_angle"][9]
    assert seen["interval"].sum() == pytest.approx(1.0)


def test_every_sample_of_an_interval_is_logged_once(recording, monkeypatch):
    logged = {"range/dte": [], "waveform/dte": []}
    monkeypatch.setattr(waveform.timeline, "columns", lambda time, stamp: time)
    monkeypatch.setattr(
        waveform,
        "log_series",
        lambda stream, path, index, values, *style: logged.setdefault(path, []).append(
            (index, values)
        ),
    )
    monkeypatch.setattr(waveform, "_CHUNK", 777)
    waveform.log_waveform(None, recording, [(0.105, 0.302), (0.5, 0.6)])
    whole = recording.waveform
    time = np.concatenate([index for index, _ in logged["waveform/dte"]])
    values = np.concatenate([values for _, values in logged["waveform/dte"]])
    kept = np.zeros(len(whole.time), dtype=bool)
    for begin, end in ((0.105, 0.302), (0.5, 0.6)):
        kept |= (whole.time >= begin) & (whole.time <= end)
    assert np.array_equal(time, whole.time[kept])
    assert np.array_equal(values, 1e6 * whole.dte[kept][:, [0, 3]].astype(float))
    ((index, ranges),) = logged["range/dte"]
    assert len(index) == 100
    assert ranges[:, 1].max() == 1e6 * float(whole.dte[:, 0].max())
