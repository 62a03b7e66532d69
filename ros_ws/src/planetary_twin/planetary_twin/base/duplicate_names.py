"""Warns if another node has the same name: both serve its services and accept its parameters."""

from __future__ import annotations

from rclpy.node import Node

from .clock import STEADY

_PERIOD = 1.0  # [s]
_LOG_PERIOD = 60.0  # [s] discovery on a busy machine may lose a node and find it again


class Namesakes:
    """Counts the nodes with the name of `node` once a second, and logs new ones."""

    def __init__(self, node: Node) -> None:
        self._node = node
        self._count = 0
        node.create_timer(_PERIOD, self._check, clock=STEADY)

    def _check(self) -> None:
        node = self._node
        own = (node.get_name(), node.get_namespace())
        known = node.get_node_names_and_namespaces().count(own)
        before, self._count = self._count, max(known - 1, 0)  # this node may be discovered late
        if self._count > before:
            node.get_logger().warning(
                f"another node is named {node.get_fully_qualified_name()}: either may answer a "
                "service, and both publish on its topics; give each a namespace, -r __ns:=/NAME",
                throttle_duration_sec=_LOG_PERIOD,
            )
