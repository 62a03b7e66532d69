"""
The events of a publisher that a node watches: subscribers whose QoS is incompatible.

rclpy also watches for subscribers with another message type. Their own nodes report this, and each
event of each publisher costs an executor time whenever it wakes.
"""

from rclpy.event_handler import PublisherEventCallbacks, QoSOfferedIncompatibleQoSInfo
from rclpy.node import Node
from rclpy.qos import qos_policy_name_from_kind


def warn_of_qos(node: Node, topic: str) -> PublisherEventCallbacks:
    """Return callbacks by which `node` warns of subscribers that its `topic` cannot serve."""

    def warn(event: QoSOfferedIncompatibleQoSInfo) -> None:
        policy = qos_policy_name_from_kind(event.last_policy_kind)
        name = node.resolve_topic_name(topic)
        node.get_logger().warning(
            f"{name}: a subscriber of incompatible QoS receives nothing: {policy}"
        )

    return PublisherEventCallbacks(incompatible_qos=warn, use_default_callbacks=False)
