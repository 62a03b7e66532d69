"""The folder of a data set: the same bits with any workers, and every row can be reproduced."""

import json
import os
import signal
import subprocess
import time
from pathlib import Path

import numpy as np
import pyarrow.parquet as parquet
import pytest
from command_line import COMMAND
from dask_cluster import local_cluster, until
from datasets.small import SPEC, digests, plan_of, without, written

from planetary_twin_py.datasets import record as recording
from planetary_twin_py.datasets.folder import CHECKSUMS, check_folder
from planetary_twin_py.datasets.produce import WORK, journal_in
from planetary_twin_py.datasets.record import Recorder
from planetary_twin_py.simulation.threads import Threads
from planetary_twin_py.studies.cluster import Cluster


@pytest.fixture(scope="module")
def first(tmp_path_factory):
    """A data set by one worker, and its plan."""
    folder = tmp_path_factory.mktemp("first")
    plan = plan_of(folder)
    written(plan, folder / "set", Threads(1))
    return plan, folder / "set"


def test_any_number_of_workers_writes_the_same_bits(first, tmp_path):
    plan, folder = first
    found = digests(folder)
    assert {name.split("/")[0] for name in found} == {
        "README.md", "datasheet.md", "croissant.json", "spec.yaml", "scene.yaml", "runs.parquet",
        "data", CHECKSUMS,
    }  # fmt: skip
    for count in (2, 5):
        written(plan, tmp_path / str(count), Threads(count))
        assert digests(tmp_path / str(count)) == found


def test_checksums_are_those_of_all_other_files(first):
    _, folder = first
    found = digests(folder)
    found.pop(CHECKSUMS)
    lines = (folder / CHECKSUMS).read_text().splitlines()
    assert dict(line.split("  ")[::-1] for line in lines) == found


def test_its_own_specification_makes_the_same_data(first, tmp_path):
    _, folder = first
    text = (folder / "spec.yaml").read_text()
    (tmp_path / "scene.yaml").write_bytes((folder / "scene.yaml").read_bytes())
    written(plan_of(tmp_path, text), tmp_path / "again")
    assert digests(tmp_path / "again") == digests(folder)


def test_every_row_is_that_of_its_record_simulated_alone(first):
    plan, folder = first
    rows = {}
    for path in sorted((folder / "data").iterdir()):
        for row in parquet.read_table(path).to_pylist():
            rows[row["recording_id"]] = row
    assert len(rows) == 15
    for record in plan.records():
        row = rows[record.name]
        signal = Recorder(plan.spec, plan.scene)(record).signals[0]
        assert np.array(row["samples"], np.float32).tobytes() == signal.samples.tobytes()
        assert len(signal.samples) == row["n_samples"] == 250
        assert row["split"] == record.split and row["specimen_id"] == record.specimen_name
        assert row["mesh.sun_planet_stiffness"] == record.drawn["mesh.sun_planet_stiffness"]
        assert row["seed"] == record.changes["sensors.0.seed"]


def test_rows_say_which_fault_they_have(first):
    _, folder = first
    rows = (
        parquet.read_table(folder / "runs.parquet")
        .sort_by([("pair_id", "ascending"), ("native_label", "ascending")])
        .to_pylist()
    )
    for healthy, crack, both in zip(rows[::3], rows[1::3], rows[2::3], strict=True):
        assert (healthy["native_label"], healthy["fault_type"]) == ("healthy", "normal")
        assert healthy["fault_severity"] == healthy["fault_severity_level"] == 0
        assert (crack["fault_type"], crack["fault_location"]) == ("crack", "sun")
        fault = json.loads(crack["faults"])[0]
        assert str(fault["tooth"]) == crack["tooth"]
        assert fault["stiffness_loss"] == crack["fault_severity"]
        assert (both["fault_type"], both["fault_location"]) == ("wear+crack", "planet+ring")
        assert 1 <= int(both["planet"]) <= 3 and crack["planet"] == "none"
        assert both["fault_size_mm"] == 1e3 * both["fault_severity"]
        assert healthy["pair_id"] == crack["pair_id"] == both["pair_id"]
        assert healthy["load"] == crack["load"] and healthy["seed"] != crack["seed"]
        assert crack["speed_rpm"] == pytest.approx(healthy["speed_rpm"], rel=1e-3)


def test_no_specimen_is_in_two_parts(first):
    _, folder = first
    parts = [
        set(parquet.read_table(path)["specimen_id"].to_pylist())
        for path in (folder / "data").iterdir()
    ]
    assert len(parts) == 3 and sum(map(len, parts)) == len(set.union(*parts)) == 5


def test_finished_records_are_not_simulated_again(first, tmp_path, monkeypatch):
    plan, folder = first
    ran, simulate = [], recording.simulate

    def counted(*given, **named):
        ran.append(given)
        if len(ran) == 8:
            raise ArithmeticError("no power")
        return simulate(*given, **named)

    monkeypatch.setattr(recording, "simulate", counted)
    with pytest.raises(ValueError, match="specimen00002_run0001: no power"):
        written(plan, tmp_path / "set", Threads(1))
    assert not (tmp_path / "set" / CHECKSUMS).exists()
    before = len(ran)
    done = len(journal_in(tmp_path / "set").read_text().splitlines())
    written(plan, tmp_path / "set", Threads(1))
    assert done >= 6 and len(ran) - before == 15 - done
    assert digests(tmp_path / "set") == digests(folder)


def test_a_folder_with_other_files_or_too_small_a_disk_is_refused(tmp_path, monkeypatch):
    plan = plan_of(tmp_path, without(SPEC, "specimens"), specimens=33_000)
    with pytest.raises(ValueError, match="already exists"):
        check_folder(plan, tmp_path)
    with pytest.raises(ValueError, match="is a file"):
        check_folder(plan, tmp_path / "spec.yaml")
    room = type("Usage", (), {"free": 1e6})
    monkeypatch.setattr("shutil.disk_usage", lambda path: room)
    with pytest.raises(ValueError, match=r"99000 records need 0\.\d+ GB, and 0\.001 GB are free"):
        check_folder(plan, tmp_path / "new" / "set")


@pytest.mark.slow
def test_a_data_set_continues_after_its_process_is_killed(first, tmp_path):
    _, folder = first
    plan_of(tmp_path)
    out = tmp_path / "set"
    command = [*COMMAND, "dataset", str(tmp_path / "spec.yaml"), "--out", str(out)]
    for workers, lines in (("1", 2), ("2", 6)):
        process = subprocess.Popen([*command, "--workers", workers], stderr=subprocess.DEVNULL)
        wait_for_lines(journal_in(out), lines, process)
        os.kill(process.pid, signal.SIGKILL)
        assert process.wait() == -signal.SIGKILL
    assert (out / WORK).is_dir() and not (out / CHECKSUMS).exists()
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    assert "15 records: 5 healthy, 5 sun_crack, 5 worn+cracked" in done.stdout
    assert digests(out) == digests(folder)


def wait_for_lines(path: Path, count: int, process: subprocess.Popen) -> None:
    """Wait until a file has some lines; the process that writes it must not end before."""
    deadline = time.monotonic() + 300.0
    while not (path.exists() and path.read_bytes().count(b"\n") >= count):
        assert process.poll() is None and time.monotonic() < deadline
        time.sleep(0.005)


@pytest.mark.slow
def test_a_cluster_writes_the_same_bits(first, tmp_path):
    plan, folder = first
    with local_cluster(tmp_path) as (address, _):
        cluster = Cluster(address)
        try:
            until(lambda: len(cluster._client.nthreads()) == 2)
            written(plan, tmp_path / "set", cluster)
        finally:
            cluster.close()
    assert digests(tmp_path / "set") == digests(folder)
