"""Warns where another node has a node's name: both answer its services and take its parameters."""

from __future__ import annotations

from rclpy.node import Node

from .stamps import STEADY

_PERIOD = 1.0  # [s]


class Namesakes:
    """Counts, once a second, the nodes that are called as `node` is, and logs each further one."""

    def __init__(self, node: Node) -> None:
        self._node = node
        self._count = 0
        node.create_timer(_PERIOD, self._look, clock=STEADY)

    def _look(self) -> None:
        node = self._node
        own = (node.get_name(), node.get_namespace())
        known = node.get_node_names_and_namespaces().count(own)
        before, self._count = self._count, max(known - 1, 0)  # its own name may come late
        if self._count > before:
            node.get_logger().warning(
                f"another node is called {node.get_fully_qualified_name()}: either may answer a "
                "service, and topics carry both; give each a namespace, -r __ns:=/NAME"
            )
