"""Messages that waited for a stalled logger do not make the processes larger for good."""

from __future__ import annotations

import signal

from planetary_twin.benchmark.process import own_memory
from planetary_twin_msgs.msg import RecorderStatus

from .conftest import Start
from .peer import LONG, TWIN, Peer
from .programs import Program
from .reported import figures, listen_to_reports

# At the lowest sample rate of an overloaded twin, ten seconds of messages have 7 MB.
WAITING = 5.0  # [MB]
KEPT = 2.5  # [MB]


def test_memory_of_messages_that_waited_is_returned(peer: Peer, start: Start) -> None:
    logger = start("planetary_twin.logger")
    simulation = start("planetary_twin.simulation", "--ros-args", "-p", "wait_for:=logger")
    reports = listen_to_reports(peer)
    status = peer.listen(RecorderStatus, f"{TWIN}/logger/status", 1)
    # From then on, nothing is allocated once.
    peer.until(lambda: reports and figures(reports[-1:])["mesh_cycles"] == "repeated", LONG)
    before = {node: own_memory(node.pid) for node in (simulation, logger)}

    def grown(node: Program) -> float:
        return own_memory(node.pid) - before[node]

    logger.send_signal(signal.SIGSTOP)
    peer.until(lambda: grown(simulation) > WAITING)
    logger.send_signal(signal.SIGCONT)
    peer.until(lambda: grown(simulation) < KEPT and grown(logger) < KEPT)
    assert not any(status[-1].lost)
