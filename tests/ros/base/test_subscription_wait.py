"""A twin can wait for the node that records it, so that no message is missed."""

from types import SimpleNamespace

import pytest
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from planetary_twin.base import subscription_wait
from planetary_twin.base.subscription_wait import RECORDER, TIMEOUT, SubscriptionWait
from planetary_twin.base.topics import UNKNOWN_NODE
from planetary_twin_msgs.msg import RecorderStatus

from ..peer import TWIN, Peer
from ..reported import figures, listen_to_reports, recorded, statuses

STATES = f"{TWIN}/gearbox_state"


def accounted(peer: Peer, topic: str = STATES, messages: int = 30) -> RecorderStatus:
    """The first status of the logger that counts that many messages."""
    status = peer.listen(RecorderStatus, f"{TWIN}/logger/status")
    peer.until(lambda: recorded(status, topic) >= messages)
    return status[-1]


def test_the_logger_may_start_later_and_subscribe_to_few_topics(peer, start):
    start("planetary_twin.simulation", wait_for="logger")
    reports = listen_to_reports(peer)
    peer.until(lambda: figures(reports).get("state") == "waits")
    start("planetary_twin.logger", topics=f"[{TWIN}/joint_states]")
    status = accounted(peer, f"{TWIN}/joint_states")
    assert list(status.topics) == [f"{TWIN}/joint_states"]
    assert not any(status.lost)


def test_a_recorder_that_has_gone_is_an_error(peer, start):
    logger = start("planetary_twin.logger")
    start("planetary_twin.simulation", wait_for="logger")
    arrays = peer.listen(DiagnosticArray, "/diagnostics")

    def recorder() -> tuple[bytes, str]:
        arrays.clear()
        newest = peer.until(lambda: statuses(arrays, RECORDER))[-1]
        return newest.level, newest.message

    peer.until(lambda: recorder() == (DiagnosticStatus.OK, "logger subscribes"))
    logger.terminate()
    gone = (DiagnosticStatus.ERROR, "logger does not subscribe: nothing is recorded by it")
    peer.until(lambda: recorder() == gone)
    start("planetary_twin.logger")
    peer.until(lambda: recorder()[0] == DiagnosticStatus.OK)


def waited(
    monkeypatch: pytest.MonkeyPatch,
    listener: str,
    namespace: str = TWIN,
    name: str = "logger",
    delays: dict[str, float] | None = None,
) -> float:
    """
    Time [s] that a twin waits for `name` if the node `listener` has subscribed.

    `delays` are the times [s] after which it subscribes, by topic.
    """
    delays = {STATES: 0.0} if delays is None else delays
    info = SimpleNamespace(node_name=listener, node_namespace=namespace)
    clock = SimpleNamespace(now=100.0)

    def subscribers(topic: str) -> list[SimpleNamespace]:
        return [info] if clock.now >= 100.0 + delays[topic] else []

    node = SimpleNamespace(
        publishers=[
            SimpleNamespace(
                topic_name=topic, get_subscription_count=lambda topic=topic: len(subscribers(topic))
            )
            for topic in delays
        ],
        get_namespace=lambda: TWIN,
        get_subscriptions_info_by_topic=subscribers,
        get_logger=lambda: SimpleNamespace(info=print, warning=print),
    )
    monkeypatch.setattr(subscription_wait, "time", SimpleNamespace(monotonic=lambda: clock.now))
    waiting = SubscriptionWait(node, name)
    waiting.begin()
    while not waiting.present():
        clock.now += 0.1
    return clock.now - 100.0


def test_a_subscription_of_an_unknown_node_ends_the_wait(monkeypatch, capsys):
    assert waited(monkeypatch, "logger") < 1.0
    assert 3.0 < waited(monkeypatch, UNKNOWN_NODE) < 4.0
    assert "has not subscribed" not in capsys.readouterr().out


def test_a_logger_that_subscribes_slowly_is_waited_for(monkeypatch):
    """And one that has subscribed to all is waited for no longer."""
    delays = {STATES: 0.0, "/tf": 0.9, "/diagnostics": 1.8, f"{TWIN}/joint_states": 4.0}
    assert 4.0 <= waited(monkeypatch, "logger", delays=delays) < 4.2
    of_ros = {"/parameter_events": 99.0, f"{TWIN}/simulation/transition_event": 99.0}
    assert waited(monkeypatch, "logger", delays={STATES: 0.0} | of_ros) == 0.0
    few = {STATES: 1.0, "/tf": 99.0}
    assert 4.0 <= waited(monkeypatch, "logger", delays=few) < 4.3


def test_a_subscription_of_another_node_does_not_end_the_wait(monkeypatch, capsys):
    assert waited(monkeypatch, "rviz") > TIMEOUT
    assert "has not subscribed within 10 s; starts without it" in capsys.readouterr().out


def test_a_node_outside_the_namespace_is_named_in_full(monkeypatch):
    """Rosbag2 runs as /rosbag2_recorder, and `ros2 bag record` sets no namespace."""
    assert waited(monkeypatch, "rosbag2_recorder", "/", "/rosbag2_recorder") < 1.0
    assert waited(monkeypatch, "logger", "/") > TIMEOUT
    assert waited(monkeypatch, "logger", "/another/twin", f"{TWIN}/logger") > TIMEOUT
    assert waited(monkeypatch, "logger", name=f"{TWIN}/logger") < 1.0
