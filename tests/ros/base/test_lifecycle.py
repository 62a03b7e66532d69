"""Both nodes follow the life cycle in every order, and survive every invalid transition."""

import gc
import subprocess
import time
import weakref
from collections.abc import Iterator
from pathlib import Path

import pytest
import rclpy
from lifecycle_msgs.msg import Transition, TransitionEvent
from lifecycle_msgs.srv import ChangeState, GetAvailableTransitions
from planetary_twin.simulation.node import Simulation
from planetary_twin_msgs.srv import SetOperatingPoint, Step
from rclpy.executors import SingleThreadedExecutor
from std_srvs.srv import SetBool, Trigger

from ..conftest import Start
from ..peer import LONG, TRANSITION, TWIN, Peer
from ..programs import ended

NAMES = ("simulation", "logger", "follower", "plant")
LEGAL = {
    "unconfigured": {"configure": "inactive", "shutdown": "finalized"},
    "inactive": {"cleanup": "unconfigured", "activate": "active", "shutdown": "finalized"},
    "active": {"deactivate": "inactive", "shutdown": "finalized"},
    "finalized": {},
}
# All valid transitions, and an invalid one.
TRANSITIONS = ("configure", "cleanup", "activate", "deactivate", "shutdown", "?")
# Every legal transition, also after a second configuration.
WAY = (
    *("configure", "activate", "deactivate", "activate", "deactivate", "cleanup"),
    *("configure", "cleanup", "configure", "activate", "shutdown"),
)


class Managed:
    """A node whose life cycle a manager controls."""

    def __init__(self, peer: Peer, name: str) -> None:
        self._peer = peer
        self.node = f"{TWIN}/{name}"
        events = f"{self.node}/transition_event"
        self.events = peer.listen(TransitionEvent, events)
        peer.until(lambda: peer.node.count_publishers(events))

    def change(self, label: str) -> bool:
        request = ChangeState.Request(transition=Transition(label=label))
        service = f"{self.node}/change_state"
        return self._peer.call(ChangeState, service, request, TRANSITION).success

    @property
    def state(self) -> str:
        return self._peer.state(self.node)

    @property
    def available(self) -> set[str]:
        kind, name = GetAvailableTransitions, f"{self.node}/get_available_transitions"
        answer = self._peer.call(kind, name, kind.Request())
        return {item.transition.label for item in answer.available_transitions}


def begin(start: Start, node: str, **given: str) -> subprocess.Popen[str]:
    return start(f"planetary_twin.{node}", autostart="false", **given)


@pytest.mark.parametrize("name", NAMES)
def test_every_legal_transition_is_made_and_every_other_refused(peer, start, name):
    process = begin(start, name)
    managed = Managed(peer, name)
    state = "unconfigured"
    tried = set()
    for label in (*WAY, None):
        assert managed.state == state
        assert managed.available == set(LEGAL[state])
        if state not in tried:
            tried.add(state)
            for illegal in set(TRANSITIONS) - set(LEGAL[state]):
                assert not managed.change(illegal)
            assert managed.state == state
        if label is not None:
            assert managed.change(label)
            state = LEGAL[state][label]
    assert tried == set(LEGAL)
    goals = [event.goal_state.label for event in managed.events]
    assert goals.count("active") == 3 and goals[-1] == "finalized"
    assert process.poll() is None
    process.terminate()
    ended(process)


def test_services_of_an_inactive_simulation_answer_in_one_line(peer, start):
    begin(start, "simulation")
    managed = Managed(peer, "simulation")
    calls = (
        (SetOperatingPoint, "set_operating_point", {"names": ["backlash"], "values": [3e-7]}),
        (SetBool, "pause", {"data": True}),
        (Step, "step", {"duration": 0.1}),
        (Trigger, "reset", {}),
    )
    for label in ("configure", "activate", "deactivate", "cleanup", "shutdown"):
        if managed.state != "active":
            for kind, name, fields in calls:
                answer = peer.call(kind, f"{managed.node}/{name}", kind.Request(**fields))
                assert not answer.success
                assert "not active" in answer.message and "\n" not in answer.message
        assert managed.change(label)


@pytest.fixture
def simulation(
    domain: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> Iterator[Simulation]:
    """A managed simulation in this process."""
    monkeypatch.chdir(tmp_path)
    rclpy.init(args=["--ros-args", "-p", "autostart:=false"])
    node = Simulation()
    yield node
    node.close()
    node.destroy_node()
    rclpy.try_shutdown()


def test_cleanup_releases_the_model(simulation):
    assert simulation.trigger_configure().name == "SUCCESS"
    assert simulation.trigger_activate().name == "SUCCESS"
    held = [weakref.ref(simulation.running()), weakref.ref(simulation.running()._twin._engine)]
    assert simulation.trigger_deactivate().name == "SUCCESS"
    assert simulation.trigger_cleanup().name == "SUCCESS"
    gc.collect()
    assert [reference() for reference in held] == [None, None]


def test_a_twin_that_fails_moves_the_node_to_the_error_state(simulation):
    states = []
    close = simulation.close

    def noted() -> None:
        states.append(simulation.state)
        close()

    simulation.close = noted
    simulation.trigger_configure()
    simulation.trigger_activate()
    executor = SingleThreadedExecutor()
    executor.add_node(simulation)
    simulation.running()._advance = None  # makes the next interval raise, as a defect would
    deadline = time.monotonic() + LONG
    while simulation.state != "unconfigured":
        assert time.monotonic() < deadline
        executor.spin_once(timeout_sec=0.01)
    assert states == ["errorprocessing"]
    with pytest.raises(ValueError, match="not active"):
        simulation.running()
    assert simulation.trigger_configure().name == "SUCCESS"
    assert simulation.trigger_activate().name == "SUCCESS"
