"""A cluster of several processes gives the same table, also when one of them is killed."""

import os
import signal

import pytest
from dask_cluster import local_cluster, until
from studies.small import PAPER

from planetary_twin_py.simulation.threads import Threads
from planetary_twin_py.studies.axes import Axis
from planetary_twin_py.studies.cluster import Cluster
from planetary_twin_py.studies.plan import Settings, grid
from planetary_twin_py.studies.sweep import sweep

pytestmark = pytest.mark.slow


@pytest.fixture
def scheduler(tmp_path):
    """Address of a scheduler, and its two workers."""
    with local_cluster(tmp_path) as found:
        yield found


@pytest.mark.exhaustive
def test_points_of_a_killed_worker_are_run_by_another(scheduler):
    address, workers = scheduler
    study = grid(
        PAPER,
        [Axis("input_torque", tuple(range(10, 50)))],
        Settings(duration=0.2, settling=0.0, tolerance=1e-4),
    )
    cluster = Cluster(address)
    done = []

    def on_point(count, failure):
        done.append((count, failure))
        if sum(count for count, _ in done) == 5:
            os.kill(workers[0].pid, signal.SIGKILL)

    try:
        until(lambda: len(cluster._client.nthreads()) == 2)
        table = sweep(study, cluster, report=on_point)
    finally:
        cluster.close()
    assert workers[0].wait(10) == -signal.SIGKILL
    assert not any(failure for _, failure in done)
    assert table.equals(sweep(study, Threads()), check_metadata=True)


def test_an_address_without_a_scheduler_is_refused_in_one_line(monkeypatch):
    monkeypatch.setattr("planetary_twin_py.studies.cluster._TIMEOUT", 0.5)
    with pytest.raises(ValueError, match=r"scheduler = 'tcp://127\.0\.0\.1:1'") as refusal:
        Cluster("tcp://127.0.0.1:1")
    assert "\n" not in str(refusal.value)
