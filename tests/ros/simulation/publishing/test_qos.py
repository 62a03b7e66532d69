"""Every subscriber receives the topics that its QoS allows, or the incompatibility is logged."""

import itertools
import signal

from diagnostic_msgs.msg import DiagnosticArray
from planetary_twin_msgs.msg import GearboxState, MeshWaveform, OperatingPoint
from rclpy.event_handler import SubscriptionEventCallbacks
from rclpy.qos import DurabilityPolicy, HistoryPolicy, QoSProfile
from rclpy.qos import qos_profile_sensor_data as SENSOR_DATA
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import JointState
from std_msgs.msg import String
from tf2_msgs.msg import TFMessage

from ...peer import TWIN, Peer
from ...programs import ended

LATCHED = {f"{TWIN}/operating_point": OperatingPoint, f"{TWIN}/robot_description": String}
STREAMS = {
    f"{TWIN}/gearbox_state": GearboxState,
    f"{TWIN}/mesh_waveform": MeshWaveform,
    f"{TWIN}/joint_states": JointState,
    "/tf": TFMessage,
    "/clock": Clock,
    "/diagnostics": DiagnosticArray,
}
VOLATILE = {
    "default": QoSProfile(depth=10),
    "sensor data": SENSOR_DATA,
    "keep all": QoSProfile(history=HistoryPolicy.KEEP_ALL),
    "depth 1": QoSProfile(depth=1),
}
# Best-effort subscribers receive no latched messages: only reliable ones do.
KEPT = {"latched": QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)}


class Subscriptions:
    """Subscribers with every profile to topics."""

    def __init__(
        self, peer: Peer, topics: dict[str, type], profiles: dict[str, QoSProfile]
    ) -> None:
        self.seats = {(topic, name) for topic in topics for name in profiles}
        self.received: set[tuple[str, str]] = set()
        self.refused: set[tuple[str, str]] = set()
        for topic, kind in topics.items():
            for name, profile in profiles.items():
                seat = (topic, name)
                peer.node.create_subscription(
                    kind,
                    topic,
                    lambda _, seat=seat: self.received.add(seat),
                    profile,
                    event_callbacks=SubscriptionEventCallbacks(
                        incompatible_qos=lambda _, seat=seat: self.refused.add(seat)
                    ),
                )


def test_subscribers_receive_messages_or_the_reason_why_not(peer, start):
    process = start("planetary_twin.simulation", clock="true")
    states = peer.listen(GearboxState, f"{TWIN}/gearbox_state")
    peer.until(lambda: len(states) > 10)
    streams = Subscriptions(peer, STREAMS, VOLATILE)
    late = Subscriptions(peer, LATCHED, KEPT)
    wrong = Subscriptions(peer, STREAMS, KEPT)
    peer.until(lambda: streams.received == streams.seats)
    peer.until(lambda: late.received == late.seats)
    peer.until(lambda: wrong.refused == wrong.seats)
    assert not (streams.refused or late.refused or wrong.received)
    # A late volatile subscriber receives the next change.
    changes = Subscriptions(peer, {f"{TWIN}/operating_point": OperatingPoint}, VOLATILE)
    values = itertools.cycle((1.1, 1.2))

    def changed() -> bool:
        assert peer.set(f"{TWIN}/simulation", lambda_ratio=next(values)).successful
        return changes.received == changes.seats

    peer.until(changed)
    process.send_signal(signal.SIGINT)
    errors = ended(process)
    warnings = [line for line in errors.splitlines() if "incompatible QoS" in line]
    for topic in STREAMS:
        assert any(f"'{topic.removeprefix(TWIN + '/')}'" in line for line in warnings)
