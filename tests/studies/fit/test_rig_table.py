"""Identification of known parameters from tables in the format of a rig."""

import numpy as np
import pyarrow as pa
import pytest
from pyarrow import csv
from studies.fit.rig import PAPER, record

from planetary_twin_py.recording.tables.export import Export, export
from planetary_twin_py.recording.tables.rig_recording import write_measured
from planetary_twin_py.studies.fit.identify import Search, identify

FREE = ("lambda_ratio", "input_torque")
ELSEWHERE = {"lambda_ratio": 2.0, "input_torque": 45.0}


def assert_identified(found, **truth):
    for place, parameter in enumerate(found.parameters):
        low, high, _ = found.estimate.intervals[place]
        assert found.estimate.identifiable(place) and low < truth[parameter.name] < high
        assert high - low < 0.2 * truth[parameter.name]


@pytest.fixture(scope="module")
def exported(tmp_path_factory):
    """A gearbox whose film is thinner than that of the scene, with sensors of 0.3 %."""
    folder = tmp_path_factory.mktemp("exported")
    truth = PAPER.replace(lambda_ratio=0.7)
    path = record(folder / "bag", truth, 0.3, seed=1, share=0.003)
    export(path, Export(folder / "rig.parquet", topics=("gearbox_state",)))
    return folder / "rig.parquet"


def test_fit_of_exported_and_imported_recording_finds_the_truth(exported, tmp_path):
    write_measured(exported, PAPER, tmp_path / "rig")
    found = identify(tmp_path / "rig", Search(FREE, start=ELSEWHERE, confidence=0.999))
    assert_identified(found, lambda_ratio=0.7, input_torque=63.0)
    assert found.excerpt.scene.operating_point.input_torque == pytest.approx(63.0, rel=0.005)


@pytest.mark.parametrize(
    ("observe", "reason"),
    [
        ("dte_peak", "observe = dte_peak: was not recorded in this excerpt"),
        ("dte_waveform", "observe = dte_waveform: no waveform was recorded in this excerpt"),
        ("power_loss", "observe = power_loss: has NaN or infinite values in this excerpt"),
    ],
)
def test_an_unmeasured_quantity_cannot_be_observed(tmp_path, observe, reason):
    loss = np.append(np.full(9, 75.0), np.nan)
    table = pa.table({"time": np.arange(10) / 100.0, "power_loss": loss})
    csv.write_csv(table, tmp_path / "rig.csv")
    write_measured(tmp_path / "rig.csv", PAPER, tmp_path / "rig")
    with pytest.raises(ValueError, match=reason):
        identify(tmp_path / "rig", Search(("lambda_ratio",), (observe,)))


def test_by_default_what_was_recorded_is_observed(tmp_path):
    rows = {"simulated_time": 0.01 * np.arange(1, 31), "power_loss": 80.0 + 0.1 * np.cos(range(30))}
    csv.write_csv(pa.table(rows), tmp_path / "rig.csv")
    write_measured(tmp_path / "rig.csv", PAPER, tmp_path / "rig")
    found = identify(tmp_path / "rig", Search(("lambda_ratio",)))
    assert [readings.name for readings in found.weighted.recorded] == ["power_loss"]


def test_without_a_default_what_was_recorded_is_named(tmp_path):
    rows = {"simulated_time": 0.01 * np.arange(1, 31), "input_torque": np.full(30, 63.0)}
    csv.write_csv(pa.table(rows), tmp_path / "rig.csv")
    write_measured(tmp_path / "rig.csv", PAPER, tmp_path / "rig")
    with pytest.raises(ValueError, match=r"neither dte_rms nor power_loss; has .*input_torque"):
        identify(tmp_path / "rig", Search(("lambda_ratio",)))
