"""Converts the measurements of a plant to messages."""

from __future__ import annotations

from typing import Any

from sensor_msgs.msg import JointState, Temperature

from planetary_twin_py.following.channels.all import OIL
from planetary_twin_py.following.channels.sampled import DEVICES
from planetary_twin_py.following.channels.temperature import ZERO_CELSIUS
from planetary_twin_py.following.measured.messages import INTERFACES
from planetary_twin_py.plant.device import simulated
from planetary_twin_py.plant.hidden import Hidden
from planetary_twin_py.plant.timeline import Measured, OilReading, Packet, ShaftReading

from ..base.clock import set_stamp
from ..base.topics import message_class

SHAFTS = "joint_states"
"""Name of the topic of torques and speeds."""
_SIDES = "input", "output"


class PlantMessages:
    """
    Converts measurements to messages in `frame`.

    `joints` are the names of the joints of input and output.
    """

    def __init__(self, joints: tuple[str, str], hidden: Hidden, frame: str) -> None:
        self._joints, self._frame = joints, frame
        self._hidden = hidden
        self._sent = dict.fromkeys(DEVICES, 0)  # packets

    def message(self, measured: Measured, origin: int) -> tuple[str, Any]:
        """
        Return the name of a topic below `measured`, and its message.

        `origin` is the ROS time [ns] of time 0 of the plant.
        """
        topic, time, message = self._unstamped(measured)
        message.header.frame_id = self._frame
        set_stamp(message.header.stamp, origin + round(time * 1e9))
        return topic, message

    def _unstamped(self, measured: Measured) -> tuple[str, float, Any]:
        """Return the topic, the time of the stamp [s] and a message without it."""
        if isinstance(measured, ShaftReading):
            return SHAFTS, measured.time, self._shafts(measured)
        if isinstance(measured, OilReading):
            degrees = measured.temperature - ZERO_CELSIUS
            return OIL, measured.time, Temperature(temperature=degrees)
        rate = self._hidden.device(measured.device).rate
        return measured.device, measured.first / rate, self._block(measured)

    def _shafts(self, reading: ShaftReading) -> JointState:
        fields = {
            field: [reading.values[f"{side}_{quantity}"] for side in _SIDES]
            for field, quantity in INTERFACES.items()
        }
        return JointState(name=list(self._joints), position=list(reading.angles), **fields)

    def _block(self, packet: Packet) -> Any:
        name, errors = packet.device, self._hidden.device(packet.device)
        self._sent[name] += 1
        return message_class(DEVICES[name].message)(
            sequence=self._sent[name],
            sample_period=1.0 / errors.rate,
            **simulated(name).message_fields(errors, packet.first, packet.values),
        )
