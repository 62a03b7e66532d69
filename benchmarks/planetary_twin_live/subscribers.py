"""Subscribers without further work, each a separate DDS participant, as separate programs are."""

from __future__ import annotations

import contextlib
import sys
import threading

import rclpy
from planetary_twin_msgs.msg import GearboxState, MeshWaveform
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rclpy.signals import SignalHandlerOptions

TOPICS = {"gearbox_state": GearboxState, "mesh_waveform": MeshWaveform}


def _subscribe(context: rclpy.Context, namespace: str) -> None:
    node = rclpy.create_node("listener", namespace=namespace, context=context)

    def ignore(raw: bytes) -> None:
        """Do nothing: receiving the message is the least cost of a subscription."""

    for name, kind in TOPICS.items():
        node.create_subscription(kind, name, ignore, 10, raw=True)
    executor = SingleThreadedExecutor(context=context)
    executor.add_node(node)
    with contextlib.suppress(ExternalShutdownException):
        executor.spin()


def main(args: list[str] | None = None) -> int:
    """Subscribe with as many participants as the parameter `listeners` gives, until a signal."""
    rclpy.init(args=args)
    node = rclpy.create_node("subscribers")
    contexts = [rclpy.Context() for _ in range(node.declare_parameter("listeners", 1).value)]
    threads = []
    for context in contexts:
        rclpy.init(context=context, signal_handler_options=SignalHandlerOptions.NO)
        threads.append(threading.Thread(target=_subscribe, args=(context, node.get_namespace())))
        threads[-1].start()
    with contextlib.suppress(KeyboardInterrupt, ExternalShutdownException):
        rclpy.spin(node)
    for context in contexts:
        context.try_shutdown()
    for thread in threads:
        thread.join()
    return 0


if __name__ == "__main__":
    sys.exit(main())
