"""Converts quality of service to the notation of rosbag2, and back."""

from __future__ import annotations

from collections.abc import Mapping
from enum import IntEnum
from typing import Any

from rclpy.duration import Duration, Infinite
from rclpy.qos import (
    DurabilityPolicy,
    HistoryPolicy,
    LivelinessPolicy,
    QoSProfile,
    ReliabilityPolicy,
)

from planetary_twin_py.recording.ros2.metadata import Topic

LATCHED = QoSProfile(depth=100, durability=DurabilityPolicy.TRANSIENT_LOCAL)
"""Late subscribers receive up to 100 messages, in order."""
# Messages that a publisher keeps for retransmission if the recording lacks the depth: most
# middleware does not report it.
_DEPTH = 100


def to_words(qos: QoSProfile) -> dict[str, Any]:
    """Return the profile as rosbag2 writes it."""
    return {
        "history": _word(HistoryPolicy(qos.history)),
        "depth": qos.depth,
        "reliability": _word(ReliabilityPolicy(qos.reliability)),
        "durability": _word(DurabilityPolicy(qos.durability)),
        "deadline": _span(qos.deadline),
        "lifespan": _span(qos.lifespan),
        "liveliness": _word(LivelinessPolicy(qos.liveliness)),
        "liveliness_lease_duration": _span(qos.liveliness_lease_duration),
        "avoid_ros_namespace_conventions": qos.avoid_ros_namespace_conventions,
    }


def publisher_qos(topic: Topic) -> QoSProfile:
    """
    Return a profile compatible with every subscription that matched a publisher of `topic`.

    It has the strongest reliability and durability that any recorded publisher offered.
    """
    offers = topic.offered_qos or [to_words(QoSProfile(depth=_DEPTH))]
    first = offers[0]
    reliable = any(_policy(ReliabilityPolicy, o["reliability"]) != _BEST_EFFORT for o in offers)
    every = any(_policy(HistoryPolicy, o["history"]) == HistoryPolicy.KEEP_ALL for o in offers)
    return QoSProfile(
        history=HistoryPolicy.KEEP_ALL if every else HistoryPolicy.KEEP_LAST,
        depth=topic.kept or max(int(offer["depth"]) for offer in offers) or _DEPTH,
        reliability=ReliabilityPolicy.RELIABLE if reliable else _BEST_EFFORT,
        durability=DurabilityPolicy.TRANSIENT_LOCAL if topic.kept else DurabilityPolicy.VOLATILE,
        deadline=_duration(first["deadline"]),
        lifespan=_duration(first["lifespan"]),
        liveliness=_policy(LivelinessPolicy, first["liveliness"]),
        liveliness_lease_duration=_duration(first["liveliness_lease_duration"]),
        avoid_ros_namespace_conventions=bool(first["avoid_ros_namespace_conventions"]),
    )


_BEST_EFFORT = ReliabilityPolicy.BEST_EFFORT


def _word(policy: Any) -> str:
    return policy.name.lower()


def _policy(kind: type[IntEnum], written: str | int) -> Any:
    """Return a policy from its name, or from its number in bags before version 9."""
    return kind(written) if isinstance(written, int) else kind[written.upper()]


def _span(duration: Duration) -> dict[str, int]:
    infinite = duration == Infinite
    nanoseconds = 2**63 - 1 if infinite else duration.nanoseconds
    return {"sec": nanoseconds // 1_000_000_000, "nsec": nanoseconds % 1_000_000_000}


def _duration(span: Mapping[str, int]) -> Duration:
    return Duration(nanoseconds=span["sec"] * 1_000_000_000 + span["nsec"])
