"""Sequence numbers have no gaps and stamps increase under any sequence of requests."""

import itertools

from planetary_twin_msgs.msg import GearboxState, MeshWaveform, OperatingPoint
from planetary_twin_msgs.srv import Step
from std_srvs.srv import Trigger

from ...peer import LATCHED, TWIN
from ...reported import check_rising

NODE = f"{TWIN}/simulation"


def test_no_sequence_of_requests_breaks_numbers_or_stamps(peer, start):
    start("planetary_twin.simulation")
    topics = {"gearbox_state": GearboxState, "mesh_waveform": MeshWaveform}
    received = {name: peer.listen(kind, f"{TWIN}/{name}", 1000) for name, kind in topics.items()}
    points = received["operating_point"] = peer.listen(
        OperatingPoint, f"{TWIN}/operating_point", LATCHED
    )
    states = received["gearbox_state"]

    def run() -> None:
        count = len(states)
        peer.until(lambda: len(states) > count + 5)

    run()
    peer.until(lambda: points)
    assert peer.set(NODE, lambda_ratio=1.6).successful
    peer.until(lambda: points[-1].lambda_ratio == 1.6)
    peer.pause(NODE)
    for value in (2e-7, 2.5e-7, 3e-7):
        assert peer.set(NODE, backlash=value).successful
        peer.until(lambda value=value: points[-1].backlash == value)
    assert peer.call(Step, f"{NODE}/step", Step.Request(duration=0.025)).success
    peer.pause(NODE, False)
    run()
    assert peer.call(Trigger, f"{NODE}/reset", Trigger.Request()).success
    run()
    peer.change_state(NODE, "deactivate")
    assert peer.set(NODE, backlash=4e-7).successful
    peer.change_state(NODE, "activate")
    peer.until(lambda: points[-1].backlash == 4e-7)
    run()
    for label in ("deactivate", "cleanup", "configure"):
        peer.change_state(NODE, label)
    # Publishers are new, and send their first messages to the subscribers found so far.
    peer.until(lambda: all(peer.node.count_publishers(f"{TWIN}/{name}") for name in received))
    peer.change_state(NODE, "activate")
    run()
    check_rising(*received.values())
    assert sum(b.simulated_time < a.simulated_time for a, b in itertools.pairwise(states)) == 2
