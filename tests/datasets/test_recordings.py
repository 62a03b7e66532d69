"""MCAP beside the tables: a run that verifies, with the samples of its rows."""

from dataclasses import replace

import numpy as np
import pyarrow.parquet as parquet
import pytest
from datasets.small import SPEC, plan_of, without, written

import planetary_twin_py as pt
from planetary_twin_py.datasets.record import RATE, Recorder
from planetary_twin_py.datasets.spec import STEP
from planetary_twin_py.recording.runs.offline import NAMESPACE
from planetary_twin_py.recording.runs.recorded_commands import recorded_commands
from planetary_twin_py.recording.runs.verify import verify
from planetary_twin_py.simulation.threads import Threads


@pytest.fixture(scope="module")
def recorded(tmp_path_factory):
    folder = tmp_path_factory.mktemp("recorded")
    text = without(SPEC, "specimens").replace("settling: 0.02", "settling: 0.1")
    plan = plan_of(folder, text, specimens=3, mcap="true",
                   splits="{train: 0.34, validation: 0.33, test: 0.33}")  # fmt: skip
    written(plan, folder / "set", Threads(2))
    return plan, folder / "set"


def test_rows_are_the_same_with_and_without_recordings(recorded):
    plan, folder = recorded
    plain = Recorder(plan.spec.model_copy(update={"mcap": False}), plan.scene)
    rows = {
        row["recording_id"]: row
        for path in (folder / "data").iterdir()
        for row in parquet.read_table(path).to_pylist()
    }
    for record in plan.records():
        samples = np.array(rows[record.name]["samples"], np.float32)
        assert plain(record).signals[0].samples.tobytes() == samples.tobytes()


def test_a_recording_verifies_and_repeats_its_row(recorded):
    plan, folder = recorded
    record = next(record for record in plan.records() if record.state == 2)
    path = folder / "mcap" / f"{record.name}.mcap"
    assert verify(path, NAMESPACE).first_difference is None
    remarks = []
    commands = recorded_commands(path, remarks)
    assert remarks == []
    scene = plan.scene.replace(**record.changes)
    spec = plan.spec
    # A value that is reached along a straight line is recorded at its start.
    commands = replace(commands, time=commands.time + STEP)
    run = pt.simulate(
        scene, spec.duration + 0.05, RATE, tolerance=spec.tolerance, settling=spec.settling,
        commands=commands,
    )  # fmt: skip
    (signal,) = Recorder(spec, plan.scene)(record).signals
    assert run.sensors["ring"].values[: len(signal.samples)].astype(np.float32).tobytes() == (
        signal.samples.tobytes()
    )
