"""Checks of `planetary-twin doctor` that need ROS 2: the middleware and its shared memory."""

from __future__ import annotations

import os
import time
from collections.abc import Iterator
from pathlib import Path

import rclpy
from planetary_twin_msgs.msg import GearboxState
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.utilities import get_rmw_implementation_identifier

from planetary_twin_py.doctor.finding import Finding

from ..process.environment import choose_log_folder
from .loopback import stay_on_this_machine

_TIMEOUT = 5.0  # [s] for two participants to discover each other
_SHARED_MEMORY = Path("/dev/shm")
_SWEEP = "rm /dev/shm/*fastrtps_*"


def check() -> Iterator[Finding]:
    """Check ROS 2 itself, the transport between two participants, and shared memory."""
    stay_on_this_machine()
    choose_log_folder()
    domain = os.environ.get("ROS_DOMAIN_ID", "0")
    distribution = os.environ.get("ROS_DISTRO", "jazzy, from wheels")
    middleware = get_rmw_implementation_identifier()
    yield Finding("ros", "sound", f"{distribution}; {middleware}; domain {domain}")
    yield _conversation()
    yield _leftovers()


def _conversation() -> Finding:
    """Send a message of this project between two participants of this domain."""
    contexts = [Context(), Context()]
    start = time.monotonic()
    try:
        for context in contexts:
            rclpy.init(context=context)
        sender, receiver = (
            Node(f"planetary_twin_doctor_{role}", context=context, enable_rosout=False)
            for role, context in zip(("sender", "receiver"), contexts, strict=True)
        )
        arrival = _arrival(sender, receiver, start + _TIMEOUT)
    finally:
        for context in contexts:
            rclpy.try_shutdown(context=context)
    if arrival:
        return Finding(
            "middleware", "sound", f"a message arrived {arrival - start:.1f} s after the start"
        )
    remedy = (
        "check ROS_DOMAIN_ID, the firewall of the loopback interface, and RMW_IMPLEMENTATION; "
        f"with no node running: {_SWEEP}"
    )
    return Finding("middleware", "broken", f"no message arrived within {_TIMEOUT:g} s", remedy)


def _arrival(sender: Node, receiver: Node, deadline: float) -> float | None:
    """Return the time at which `receiver` gets a message of `sender`; None after `deadline`."""
    arrivals: list[float] = []
    topic = f"planetary_twin_doctor/p{os.getpid()}"  # checks in parallel use separate topics
    receiver.create_subscription(
        GearboxState, topic, lambda _: arrivals.append(time.monotonic()), 1
    )
    publisher = sender.create_publisher(GearboxState, topic, 1)
    executor = SingleThreadedExecutor(context=receiver.context)
    executor.add_node(receiver)
    while not arrivals and time.monotonic() < deadline:
        publisher.publish(GearboxState())
        executor.spin_once(timeout_sec=0.05)
    executor.shutdown()
    return arrivals[0] if arrivals else None


def _leftovers() -> Finding:
    """Find shared memory left by killed nodes: new nodes print errors about it."""
    mapped = _mapped()
    left = [
        file
        for file in _SHARED_MEMORY.glob("fastrtps_*")
        if "_el" not in file.name and str(file) not in mapped
    ]
    if not left:
        return Finding("shared memory", "sound", "nothing left behind by killed nodes")
    text = f"{len(left)} segments left behind by killed nodes"
    return Finding("shared memory", "sound", text, f"with no node running: {_SWEEP}")


def _mapped() -> set[str]:
    """Return the shared memory files that processes map, as far as this user may see."""
    found = set()
    for maps in Path("/proc").glob("[0-9]*/maps"):
        try:
            lines = maps.read_text().splitlines()
        except OSError:
            continue
        found |= {line.split()[-1] for line in lines if str(_SHARED_MEMORY) in line}
    return found
