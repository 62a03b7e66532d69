"""A node of its own beside a twin's, through which a command listens and asks."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from types import TracebackType
from typing import Any, Self

import rclpy
from rclpy.client import Client as Service
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rclpy.signals import SignalHandlerOptions

PATIENCE = 2.0  # [s] the answer to a first call after discovery may get lost: ask again
_POLL = 0.02  # [s]


class Client:
    """Spins in a thread of its own; `watch` is called while it waits."""

    def __init__(
        self, name: str, namespace: str, watch: Callable[[], None] = lambda: None
    ) -> None:
        self.watch = watch
        self._context = rclpy.Context()
        # Signals stay Python's: they interrupt the waiting below, never a middleware call.
        rclpy.init(context=self._context, signal_handler_options=SignalHandlerOptions.NO)
        self.node = rclpy.create_node(name, namespace=namespace, context=self._context)
        self.namespace = self.node.get_namespace()
        self._executor = SingleThreadedExecutor(context=self._context)
        self._executor.add_node(self.node)
        self._thread = threading.Thread(target=self._spin, name=name, daemon=True)

    def __enter__(self) -> Self:
        self._thread.start()
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        value: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._context.try_shutdown()
        self._thread.join()
        self.node.destroy_node()

    def wait(self, ready: Callable[[], Any], seconds: float) -> bool:
        """Return True as soon as `ready`, False after `seconds`."""
        deadline = time.monotonic() + seconds
        while not ready():
            if time.monotonic() > deadline:
                return False
            self.watch()
            time.sleep(_POLL)
        return True

    def call(self, service: Service, request: Any, patience: float = PATIENCE) -> Any:
        """Return the answer of a service, or None where there is none in time."""
        if not self.wait(service.service_is_ready, patience):
            return None
        future = service.call_async(request)
        if self.wait(future.done, patience):
            return future.result()
        service.remove_pending_request(future)
        return None

    def _spin(self) -> None:
        try:
            self._executor.spin()
        except ExternalShutdownException:
            pass
        except RuntimeError:  # of rcl
            if self._context.ok():  # else the shutdown fell between two waits
                raise
