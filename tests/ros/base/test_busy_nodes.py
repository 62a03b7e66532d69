"""Services are answered while a node is busy."""

import subprocess
import sys
from pathlib import Path

from planetary_twin_msgs.msg import GearboxState, MeshWaveform, RecorderStatus
from std_srvs.srv import SetBool, Trigger

from ..peer import TWIN, Peer

HERE = Path(__file__).parents[1]
REQUESTS = 20
NUMBERS = f"{TWIN}/numbers"


def assert_answers(peer: Peer, node: str, parameter: str) -> None:
    """Every request of another process is answered while this one receives all messages."""
    command = [sys.executable, str(HERE / "requester.py"), node, parameter, str(REQUESTS)]
    requester = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    peer.until(lambda: requester.poll() is not None)
    answers, errors = requester.communicate()
    assert requester.returncode == 0, errors
    assert len(answers.splitlines()) == REQUESTS


def test_a_simulation_as_fast_as_possible_answers(peer, start):
    states = peer.listen(GearboxState, f"{TWIN}/gearbox_state", 1000)
    waves = peer.listen(MeshWaveform, f"{TWIN}/mesh_waveform", 1000)
    start("planetary_twin.simulation", rate_factor=0.0)
    peer.until(lambda: len(states) > 100 and len(waves) > 100)
    node = f"{TWIN}/simulation"
    assert_answers(peer, node, "backlash")
    for paused in (True, False):
        assert peer.call(SetBool, f"{node}/pause", SetBool.Request(data=paused)).success
    assert peer.set(node, backlash=3e-7).successful


def test_an_overloaded_logger_answers(peer, start):
    status = peer.listen(RecorderStatus, f"{TWIN}/logger/status")
    start("planetary_twin.logger", topics=f"['{NUMBERS}']")
    count, size, depth = map(str, (10**9, 400, 1000))
    flood = [sys.executable, str(HERE / "counter.py"), NUMBERS, "0", count, size, depth, "RELIABLE"]
    sender = subprocess.Popen(flood, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
    try:
        peer.until(lambda: status and sum(status[-1].recorded) > 1000)
        node = f"{TWIN}/logger"
        assert_answers(peer, node, "compression")
        assert peer.call(Trigger, f"{node}/split", Trigger.Request()).success
    finally:
        sender.kill()
        sender.communicate()
