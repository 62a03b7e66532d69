"""A stall of the logger does not make the processes larger for good."""

import signal

from planetary_twin_live.process import own_memory
from planetary_twin_msgs.msg import RecorderStatus

from ..peer import LONG, TWIN
from ..reported import figures, listen_to_reports

# At the lowest sample rate of an overloaded twin, ten seconds of messages have 7 MB.
WAITING = 5.0  # [MB]
KEPT = 2.5  # [MB] histories and a longer mesh cycle at a tighter tolerance are kept for reuse


def test_memory_of_messages_that_waited_is_returned(peer, start):
    simulation = start("planetary_twin.simulation", wait_for="logger")
    logger = start("planetary_twin.logger")
    reports = listen_to_reports(peer)
    # By then, what is allocated once has been.
    peer.until(lambda: reports and figures(reports[-1:])["mesh_cycles"] == "repeated", LONG)
    before = {process: own_memory(process.pid) for process in (simulation, logger)}

    def grown() -> list[float]:
        return [own_memory(process.pid) - memory for process, memory in before.items()]

    status = peer.listen(RecorderStatus, f"{TWIN}/logger/status", 1)
    logger.send_signal(signal.SIGSTOP)
    peer.until(lambda: grown()[0] > WAITING)
    logger.send_signal(signal.SIGCONT)
    peer.until(lambda: max(grown()) < KEPT)
    peer.until(lambda: status)
    assert not any(status[-1].lost)
