"""Sets the operating point of a running simulation to the estimates of a follower."""

from __future__ import annotations

import math
import time
from collections.abc import Mapping

from planetary_twin_msgs.srv import SetOperatingPoint
from rclpy.node import Node
from rclpy.task import Future

from planetary_twin_py.following.state import Following
from planetary_twin_py.following.train import FollowedTrain

PERIOD = 1.0  # [s] smallest time between two changes
RAMP = 1.0  # [s] duration of a change: a step would excite vibration of the couplings
_SMALL = 0.005  # relative change of torque and speed, to those of the scene, that is sent
_OIL_STEP = 0.5  # [K] change of the oil temperature that is sent
_LOG_PERIOD = 10.0  # [s]


class TwinBeside:
    """
    Sends torque, speed and oil temperature to the simulation `name` as linear ramps.

    It sends at most once a second, and only if a quantity has changed by 0.5 % of its value in the
    scene of `train`, or by 0.5 K.
    """

    def __init__(self, node: Node, name: str, train: FollowedTrain) -> None:
        self._node = node
        self._client = node.create_client(SetOperatingPoint, f"{name}/set_operating_point")
        self._steps = {
            "input_torque": _SMALL * train.torque,
            "input_speed": _SMALL * train.speed,
            "oil_temperature": _OIL_STEP,
        }
        self._sent: dict[str, float] = {}
        self._next = 0.0
        self._waiting: Future | None = None

    def follow(self, state: Following) -> None:
        """Send changed quantities, without waiting for an answer."""
        now = time.monotonic()
        if now < self._next:
            return
        self._next = now + PERIOD
        if not self._client.service_is_ready():
            self._sent = {}
            return
        values = _values(state)
        if all(self._near(name, value) for name, value in values.items()):
            return
        if self._waiting is not None and not self._waiting.done():
            self._client.remove_pending_request(self._waiting)
        request = SetOperatingPoint.Request(
            names=list(values), values=list(values.values()), ramp=RAMP
        )
        self._sent = dict(values)
        self._waiting = self._client.call_async(request)
        self._waiting.add_done_callback(self._answered)

    def close(self) -> None:
        """Destroy the client."""
        self._node.destroy_client(self._client)

    def _near(self, name: str, value: float) -> bool:
        return abs(self._sent.get(name, math.inf) - value) < self._steps[name]

    def _answered(self, future: Future) -> None:
        answer = future.result()
        if answer is not None and not answer.success:
            self._node.get_logger().warning(
                f"the simulation refuses estimates: {answer.message}",
                throttle_duration_sec=_LOG_PERIOD,
            )


def _values(state: Following) -> Mapping[str, float]:
    """Return the operating point as far as it is estimated."""
    torque = state["input_torque"]
    speed, oil = state.operating
    values = {
        "input_torque": torque.value if torque.status == "ESTIMATED" else math.nan,
        "input_speed": speed,
        "oil_temperature": oil,
    }
    return {name: value for name, value in values.items() if math.isfinite(value)}
