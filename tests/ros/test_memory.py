"""Neither a stall of the logger nor changes of parameters make the processes larger for good."""

from __future__ import annotations

import signal
from collections.abc import Callable

import pytest
from planetary_twin.benchmark.process import own_memory
from planetary_twin_msgs.msg import RecorderStatus

from .conftest import Start
from .peer import LONG, TWIN, Peer
from .programs import Program
from .reported import figures, listen_to_reports

# At the lowest sample rate of an overloaded twin, ten seconds of messages have 7 MB.
WAITING = 5.0  # [MB]
KEPT = 2.5  # [MB] histories and a longer mesh cycle at a tighter tolerance are kept for reuse
Growth = Callable[[], float]


@pytest.fixture
def simulation(peer: Peer, start: Start) -> Program:
    """A simulation that a logger records."""
    return start("planetary_twin.simulation", wait_for="logger")


@pytest.fixture
def logger(start: Start) -> Program:
    return start("planetary_twin.logger")


@pytest.fixture
def growths(peer: Peer, simulation: Program, logger: Program) -> tuple[Growth, Growth]:
    """By how much the memory of simulation and logger has grown [MB] since a steady state."""
    reports = listen_to_reports(peer)
    # By then, what is allocated once has been.
    peer.until(lambda: reports and figures(reports[-1:])["mesh_cycles"] == "repeated", LONG)
    first, second = own_memory(simulation.pid), own_memory(logger.pid)
    return lambda: own_memory(simulation.pid) - first, lambda: own_memory(logger.pid) - second


def test_memory_of_messages_that_waited_is_returned(
    peer: Peer, logger: Program, growths: tuple[Growth, Growth]
) -> None:
    status = peer.listen(RecorderStatus, f"{TWIN}/logger/status", 1)
    of_simulation, of_logger = growths
    logger.send_signal(signal.SIGSTOP)
    peer.until(lambda: of_simulation() > WAITING)
    logger.send_signal(signal.SIGCONT)
    peer.until(lambda: of_simulation() < KEPT and of_logger() < KEPT)
    peer.until(lambda: status)
    assert not any(status[-1].lost)
