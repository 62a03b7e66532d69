"""A recording contains every published message, at any speed and after any stall."""

import json
import signal
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
from diagnostic_msgs.msg import DiagnosticArray
from planetary_twin.base.subscription_wait import full_name
from planetary_twin.simulation.publishing.publishers import STALL
from planetary_twin_msgs.msg import GearboxState, RecorderStatus
from planetary_twin_msgs.srv import Step
from std_msgs.msg import String
from std_srvs.srv import SetBool
from tiers import first_rows

from ...conftest import Program, Start
from ...other_recorder import COUNTS, LATCHED, NAME, TOPICS
from ...peer import TWIN, Peer
from ...recordings import counts
from ...reported import figures, listen_to_reports, published

NODE = f"{TWIN}/simulation"
STREAMS = (f"{TWIN}/gearbox_state", f"{TWIN}/mesh_waveform", f"{TWIN}/joint_states", "/tf")
STEP = 8.0  # [s]
OFTEN = 5  # changes of the operating point while the recorder is stopped


@pytest.fixture
def other(execute: Start, monkeypatch: pytest.MonkeyPatch) -> Program:
    """A recorder that is not the logger."""
    monkeypatch.setenv("PYTHONPATH", str(Path(__file__).parents[3]))
    return execute("ros.other_recorder")


class Twin:
    """A simulation, the recorder it waits for, and what both report."""

    def __init__(
        self, peer: Peer, start: Start, recorder: Program, name: str, rate: float, **more: float
    ) -> None:
        self.peer = peer
        self.recorder = recorder
        self.process = start("planetary_twin.simulation", rate_factor=rate, wait_for=name, **more)
        status = f"{full_name(TWIN, name)}/status"
        self.status: list[RecorderStatus] = peer.listen(RecorderStatus, status, 1)
        self.states: list[GearboxState] = peer.listen(GearboxState, STREAMS[0], 1)
        self.reports: list[DiagnosticArray] = listen_to_reports(peer)

    def advance(self, seconds: float) -> None:
        """Wait until it has simulated that much more."""
        self.peer.until(lambda: self.states)
        begin = self.states[-1].simulated_time
        self.peer.until(lambda: self.states[-1].simulated_time > begin + seconds)

    def pause(self, paused: bool) -> None:
        assert self.peer.call(SetBool, f"{NODE}/pause", SetBool.Request(data=paused)).success

    @contextmanager
    def stall(self, seconds: float) -> Iterator[None]:
        """Stop the recorder for at least that long, as an overloaded machine does."""
        end = time.monotonic() + seconds
        if seconds:
            self.recorder.send_signal(signal.SIGSTOP)
        timer = threading.Timer(seconds, self.recorder.send_signal, [signal.SIGCONT])
        timer.start()
        yield
        self.peer.until(lambda: time.monotonic() > end)
        timer.join()

    def end(self) -> dict[str, str]:
        """Stop it; returns the values of its last report."""
        self.peer.change_state(NODE, "deactivate")
        self.peer.until(lambda: figures(self.reports[-1:]).get("state") == "stopped")
        return figures(self.reports[-1:])


def run_on(twin: Twin) -> None:
    """The twin runs while the recorder is stopped, and the operating point changes."""
    for number in range(OFTEN):
        assert twin.peer.set(NODE, lambda_ratio=1.0 + 0.1 * number).successful


def step(twin: Twin) -> None:
    """Steps that publish more messages than any queue of the middleware holds."""
    request = Step.Request(duration=STEP)
    assert twin.peer.call(Step, f"{NODE}/step", request, 100.0).success


def rest(twin: Twin) -> None:
    """The twin is paused, and resumes while the recorder is still stopped."""
    twin.pause(True)
    twin.pause(False)


CELLS = [(1.0, 2.0, run_on), (0.0, 2.0, run_on), (1.0, 2.0, step)]
MORE = [(20.0, 7.0, run_on), (1.0, 7.0, step), (0.0, 3.0, rest)]


@pytest.mark.parametrize(("rate", "stall", "meanwhile"), first_rows(len(CELLS), CELLS + MORE))
def test_the_logger_records_all_that_is_published(peer, start, tmp_path, rate, stall, meanwhile):
    assert stall < STALL
    logger = start("planetary_twin.logger", name="bag")
    twin = Twin(peer, start, logger, "logger", rate)
    twin.advance(0.05)
    if meanwhile is step:
        twin.pause(True)
    with twin.stall(stall):
        meanwhile(twin)
    if meanwhile is not step:
        twin.advance(0.05)
    sent = published(twin.end())

    def accounted() -> bool:
        if not twin.status:
            return False
        status = twin.status[-1]
        known = zip(status.topics, status.recorded, status.lost, strict=True)
        return {name: recorded + lost for name, recorded, lost in known} == sent

    peer.until(accounted)
    logger.terminate()
    _, errors = logger.communicate()
    assert logger.returncode == 0
    assert "lost none" in errors
    # The simulation reports how it is while it still waits for its logger.
    early = dict(zip(twin.status[-1].topics, twin.status[-1].before, strict=True))
    assert {name for name, number in early.items() if number} <= {"/diagnostics"}
    recorded = {name: number - early[name] for name, number in sent.items()}
    assert counts(tmp_path / "recordings/bag") == recorded


@pytest.mark.exhaustive
@pytest.mark.parametrize(("rate", "each", "stall"), [(1.0, 10.0, 0.3), (0.0, 100.0, 3.0)])
def test_another_recorder_with_a_long_queue_receives_all(peer, start, other, rate, each, stall):
    """At real time its queue of 10 limits a stall, to 1 s here; above, the twin waits for it."""
    received = peer.listen(String, COUNTS, LATCHED)
    twin = Twin(peer, start, other, NAME, rate, publish_rate=each)
    twin.advance(0.05)
    with twin.stall(stall):
        pass
    twin.advance(0.05)
    sent = published(twin.end())
    expected = {topic: sent[topic] for topic in TOPICS}
    peer.until(lambda: received and json.loads(received[-1].data) == expected)


@pytest.mark.exhaustive
def test_a_twin_waits_for_its_recorder_only(peer, start, other):
    """Another subscriber that stalls delays nothing; the recorder delays simulated time."""
    logger = start("planetary_twin.logger")
    twin = Twin(peer, start, logger, "logger", 0.0, sample_rate=1000.0)
    twin.advance(0.5)
    listeners = (other, logger, peer)
    peer.until(lambda: peer.node.count_subscribers(STREAMS[0]) == len(listeners))
    other.send_signal(signal.SIGSTOP)
    twin.advance(2.0 * STALL)
    logger.send_signal(signal.SIGSTOP)
    peer.until(lambda: figures(twin.reports[-1:])["state"] == "waits")
    before = twin.states[-1].simulated_time
    logger.send_signal(signal.SIGCONT)
    other.send_signal(signal.SIGCONT)
    peer.until(lambda: twin.states[-1].simulated_time > before + STALL)
    assert float(twin.end()["held"]) > 1.0
