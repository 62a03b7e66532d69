"""A study gives the same table with any workers; finished points survive; failures are reported."""

import numpy as np
import pyarrow.parquet
import pytest
from scipy.integrate import trapezoid
from studies.small import PAPER, QUICK, STUDY

import planetary_twin_py as pt
from planetary_twin_py.simulation.threads import Threads
from planetary_twin_py.studies import work
from planetary_twin_py.studies.axes import Axis
from planetary_twin_py.studies.journal import Journal
from planetary_twin_py.studies.measures import measure
from planetary_twin_py.studies.plan import grid
from planetary_twin_py.studies.sweep import sweep
from planetary_twin_py.studies.table import write
from planetary_twin_py.studies.work import Failure
from planetary_twin_py.units.catalogue import STUDY_RESULTS

# So small an addendum that a tooth pair leaves before the next one enters.
BROKEN = grid(PAPER, [Axis("gearset.addendum", (0.3, 1.0))], QUICK)


@pytest.fixture
def measured(monkeypatch):
    """The points that were actually run."""
    scenes = []

    def counted(scene, settings):
        scenes.append(scene)
        return measure(scene, settings)

    monkeypatch.setattr(work, "measure", counted)
    return scenes


def test_one_worker_and_several_give_same_table_to_the_last_bit():
    alone = sweep(STUDY, Threads(1))
    assert len(alone) == len(STUDY.points)
    for count in (2, 5):
        assert sweep(STUDY, Threads(count)).equals(alone, check_metadata=True)


def test_figures_are_those_of_separate_run_over_measured_part():
    table = sweep(STUDY, Threads())
    scene = PAPER.replace(**STUDY.points[3].changes)
    whole = pt.simulate(scene, 0.03, 1e6, tolerance=1e-3)
    part = whole.time > 0.01 - 1e-9  # from the instant at which it starts
    planets = len(whole.meshes) // 2
    rows = table.to_pylist()[3]
    time, dte, force = whole.time[part], whole.dte[part], whole.mesh_force[part]

    def mean(values):
        return trapezoid(values, time, axis=0) / (time[-1] - time[0])

    rms = np.sqrt(mean((dte - mean(dte)) ** 2))
    assert rows["sun_planet_dte_mean"] == pytest.approx(mean(dte)[:planets].mean(), rel=1e-4)
    assert rows["planet_ring_dte_rms"] == pytest.approx(rms[planets:].max(), rel=1e-3)
    assert rows["sun_planet_mesh_force_peak"] == pytest.approx(
        np.abs(force[:, :planets]).max(), rel=1e-3
    )
    # Of whole steps, which end slightly after the samples that they contain.
    assert rows["power_loss"] == pytest.approx(whole.total_power_loss[part].mean(), rel=5e-3)


def test_the_table_contains_units_meanings_and_provenance(tmp_path):
    table = sweep(STUDY, Threads())
    write(table, tmp_path / "study.parquet")
    back = pyarrow.parquet.read_table(tmp_path / "study.parquet")
    assert back.equals(table, check_metadata=True)
    assert back.column_names == ["point", "input_torque", "lambda_ratio", *STUDY_RESULTS, "failure"]
    assert back.schema.field("input_torque").metadata[b"unit"] == b"N m"
    assert back.schema.field("power_loss").metadata[b"unit"] == b"W"
    assert b"scene" in back.schema.metadata and b"settings" in back.schema.metadata
    write(table, tmp_path / "study.csv")
    head, first, *_ = (tmp_path / "study.csv").read_text().splitlines()
    assert head.startswith('"point","input_torque [N m]","lambda_ratio","efficiency"')
    assert float(first.split(",")[3]) == table["efficiency"][0].as_py()


def test_a_line_truncated_by_a_kill_costs_its_point_only(tmp_path, measured):
    journal = tmp_path / "journal"
    table = sweep(STUDY, Threads(1), journal)
    text = journal.read_bytes()
    for end in (len(text) - 1, len(text) - 40, text.rfind(b"\n", 0, -1) + 2):
        journal.write_bytes(text[:end])
        measured.clear()
        assert sweep(STUDY, Threads(1), journal).equals(table)
        assert len(measured) == 1
        assert len(Journal(journal).done) == len(STUDY.points)


def test_a_point_that_fails_is_reported_and_stops_no_other(tmp_path, measured):
    reasons = []
    for _ in range(2):  # a failed point is tried again: its cause may have been removed
        table = sweep(BROKEN, Threads(), tmp_path / "journal", lambda n, why: reasons.append(why))
    assert [isinstance(why, Failure) for why in reasons if why] == [True, True]
    assert len(measured) == 3
    bad, good = table.to_pylist()
    assert bad["failure"].startswith("gearset.addendum = 0.3: ") and bad["efficiency"] is None
    assert good["failure"] is None and 0.9 < good["efficiency"] < 1.0


def test_zero_workers_are_refused():
    with pytest.raises(ValueError, match="workers = 0: must be at least 1"):
        Threads(0)
