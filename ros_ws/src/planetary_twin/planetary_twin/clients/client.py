"""A ROS node with which a command subscribes to a twin's topics and calls its services."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from functools import partial
from typing import Any, Self

import rclpy
from rclpy.client import Client as Service
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rclpy.qos import QoSProfile
from rclpy.signals import SignalHandlerOptions

from ..process.environment import choose_log_folder

TIMEOUT = 2.0  # [s] then call again: the first response after discovery may be lost
_POLL = 0.02  # [s]


class Client:
    """
    A node that spins in a separate thread.

    `name` and `namespace` are those of the node. `watch` is called repeatedly while the client
    waits; an exception that it raises ends the wait.
    """

    def __init__(
        self, name: str, namespace: str, watch: Callable[[], None] = lambda: None
    ) -> None:
        self.watch = watch
        choose_log_folder()
        self._context = rclpy.Context()
        # Python handles signals: they interrupt the waits below, never a middleware call.
        rclpy.init(context=self._context, signal_handler_options=SignalHandlerOptions.NO)
        self.node = rclpy.create_node(name, namespace=namespace, context=self._context)
        self.namespace = self.node.get_namespace()
        self._executor = SingleThreadedExecutor(context=self._context)
        self._executor.add_node(self.node)
        self._services: dict[str, Service] = {}
        self._thread = threading.Thread(target=self._spin, name=name, daemon=True)

    def __enter__(self) -> Self:
        self._thread.start()
        return self

    def __exit__(self, *raised: object) -> None:
        self._context.try_shutdown()
        self._thread.join()
        self.node.destroy_node()

    def wait(self, ready: Callable[[], Any], seconds: float) -> bool:
        """Return True as soon as `ready` returns a true value, False after `seconds`."""
        deadline = time.monotonic() + seconds
        while not ready():
            if time.monotonic() > deadline:
                return False
            self.watch()
            time.sleep(_POLL)
        return True

    def keep(self, field: str, kind: type, topic: str, qos: QoSProfile | int = 10) -> None:
        """Subscribe to `topic`: the attribute `field` is its newest message."""
        self.node.create_subscription(kind, topic, partial(setattr, self, field), qos)

    def serves(self, kind: type, service: str) -> bool:
        """Return whether there is a node with the service `service` of type `kind`."""
        return bool(self._service(kind, service).service_is_ready())

    def call(self, kind: type, service: str, request: Any, timeout: float = TIMEOUT) -> Any:
        """Return the response of a service, or None if there is none within `timeout` [s]."""
        client = self._service(kind, service)
        if not self.wait(client.service_is_ready, timeout):
            return None
        future = client.call_async(request)
        if self.wait(future.done, timeout):
            return future.result()
        client.remove_pending_request(future)
        return None

    def _service(self, kind: type, service: str) -> Service:
        if service not in self._services:
            self._services[service] = self.node.create_client(kind, service)
        return self._services[service]

    def _spin(self) -> None:
        try:
            self._executor.spin()
        except ExternalShutdownException:
            pass
        except RuntimeError:  # from rcl
            if self._context.ok():  # otherwise the shutdown came between two waits
                raise
