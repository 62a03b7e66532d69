"""What `planetary-twin doctor` looks at where ROS 2 is: the middleware, and what it leaves."""

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

from .network import stay_on_this_machine

_PATIENCE = 5.0  # [s] for two participants to find each other
_SHARED_MEMORY = Path("/dev/shm")
_SWEEP = "rm /dev/shm/*fastrtps_*"


def check() -> Iterator[Finding]:
    """ROS 2 itself, a message from one participant to another, and shared memory."""
    stay_on_this_machine()
    domain = os.environ.get("ROS_DOMAIN_ID", "0")
    distribution = os.environ.get("ROS_DISTRO", "jazzy, from wheels")
    middleware = get_rmw_implementation_identifier()
    yield Finding("ros", "sound", f"{distribution}; {middleware}; domain {domain}")
    yield _conversation()
    yield _leftovers()


def _conversation() -> Finding:
    """Send one message of ours between two participants of this domain."""
    contexts = [Context(), Context()]
    begun = time.monotonic()
    try:
        for context in contexts:
            rclpy.init(context=context)
        speaker, hearer = (
            Node(f"planetary_twin_doctor_{role}", context=context, enable_rosout=False)
            for role, context in zip(("speaks", "hears"), contexts, strict=True)
        )
        told = _carried(speaker, hearer, begun + _PATIENCE)
    finally:
        for context in contexts:
            rclpy.try_shutdown(context=context)
    if told:
        return Finding(
            "middleware", "sound", f"a message arrived {told - begun:.1f} s after the start"
        )
    mend = (
        "check ROS_DOMAIN_ID, the firewall of the loopback interface, and RMW_IMPLEMENTATION; "
        f"with no node running: {_SWEEP}"
    )
    return Finding("middleware", "broken", f"no message arrived within {_PATIENCE:g} s", mend)


def _carried(speaker: Node, hearer: Node, deadline: float) -> float | None:
    """Instant at which a message of `speaker` has reached `hearer`, None if it has not."""
    heard: list[float] = []
    topic = f"planetary_twin_doctor/p{os.getpid()}"  # a doctor beside this one has its own
    hearer.create_subscription(GearboxState, topic, lambda _: heard.append(time.monotonic()), 1)
    publisher = speaker.create_publisher(GearboxState, topic, 1)
    executor = SingleThreadedExecutor(context=hearer.context)
    executor.add_node(hearer)
    while not heard and time.monotonic() < deadline:
        publisher.publish(GearboxState())
        executor.spin_once(timeout_sec=0.05)
    executor.shutdown()
    return heard[0] if heard else None


def _leftovers() -> Finding:
    """Look for shared memory that killed nodes left: later ones print errors about it."""
    held = _mapped()
    left = [
        file
        for file in _SHARED_MEMORY.glob("fastrtps_*")
        if "_el" not in file.name and str(file) not in held
    ]
    if not left:
        return Finding("shared memory", "sound", "nothing left behind by killed nodes")
    told = f"{len(left)} segments left behind by killed nodes"
    return Finding("shared memory", "sound", told, f"with no node running: {_SWEEP}")


def _mapped() -> set[str]:
    """Shared memory that a process holds, as far as this user may see."""
    found = set()
    for maps in Path("/proc").glob("[0-9]*/maps"):
        try:
            lines = maps.read_text().splitlines()
        except OSError:
            continue
        found |= {line.split()[-1] for line in lines if str(_SHARED_MEMORY) in line}
    return found
