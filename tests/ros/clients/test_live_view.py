"""A running twin is drawn live."""

import subprocess
import sys
import time

import numpy as np
import pytest
from mcap.records import Message
from planetary_twin.clients.live_view import follow
from planetary_twin_msgs.msg import GearboxState
from rerun.chunk import RrdReader

from ..peer import TWIN

COMMAND = [sys.executable, "-c", "from planetary_twin_py.cli import main; main()", "view"]


def _view(*options: str) -> subprocess.Popen[str]:
    return subprocess.Popen(
        [*COMMAND, *options], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    )


@pytest.mark.exhaustive
def test_a_running_twin_is_drawn_or_said_to_be_absent(user, points, tmp_path):
    states = user.listen(GearboxState, f"{TWIN}/gearbox_state")
    shown, nobody = (
        _view("--during", ":2", "--namespace", name, "--save", f"{tmp_path}/{name}.rrd")
        for name in ("planetary_twin", "nobody")
    )
    user.until(lambda: shown.poll() is not None and nobody.poll() is not None)
    assert shown.returncode == 0, shown.communicate()
    times = []
    static = set()
    for chunk in RrdReader(tmp_path / "planetary_twin.rrd").stream():
        if chunk.is_static:
            static.add(chunk.entity_path)
        elif chunk.entity_path == "/mesh/dte_mean":
            times += chunk.to_record_batch().column("simulated_time").cast("int64").to_pylist()
    assert "/gears/carrier/pin_1/planet_1" in static
    user.until(lambda: states[-1].simulated_time >= 1e-9 * max(times) - 1e-6)
    received = np.rint(1e9 * np.array([state.simulated_time for state in states]))
    assert np.all(np.diff(times) > 0)
    assert len(times) >= 10 and np.isin(times, received).all()
    assert nobody.returncode == 2
    _, errors = nobody.communicate()
    assert errors == (
        "planetary-twin: no twin publishes in /nobody: start one with `planetary-twin run`, "
        "or name a recording\n"
    )
    assert not (tmp_path / "nobody.rrd").exists()


def test_what_arrives_while_the_last_batch_is_drawn_is_drawn_too(user, points):
    states = user.listen(GearboxState, f"{TWIN}/gearbox_state")
    duration = 2.0  # [s]
    batches = follow(TWIN, duration)
    next(batches)
    end, count = time.monotonic() + duration, len(states)
    user.until(lambda: time.monotonic() > end and len(states) > count + 20)
    (rest,) = batches
    assert sum(isinstance(record, Message) for record in rest) > 20
