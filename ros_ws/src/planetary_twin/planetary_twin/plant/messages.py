"""Converts the measurements of a plant to messages."""

from __future__ import annotations

from typing import Any

from planetary_twin_msgs.msg import EncoderBlock, SampledBlock
from sensor_msgs.msg import JointState, Temperature

from planetary_twin_py.following.channels.temperature import ZERO_CELSIUS
from planetary_twin_py.following.measured.messages import INTERFACES
from planetary_twin_py.plant.hidden import SensorErrors
from planetary_twin_py.plant.sampled import SAMPLED
from planetary_twin_py.plant.timeline import Measured, OilReading, Packet, ShaftReading

from ..base.clock import set_stamp

_SIDES = "input", "output"


class PlantMessages:
    """
    Converts measurements to messages in `frame`.

    `joints` are the names of the joints of input and output.
    """

    def __init__(self, joints: tuple[str, str], sensors: SensorErrors, frame: str) -> None:
        self._joints, self._frame = joints, frame
        self._sensors = sensors
        self._sent = dict.fromkeys(SAMPLED, 0)  # packets, by sensor

    def message(
        self, measured: Measured, origin: int
    ) -> JointState | Temperature | EncoderBlock | SampledBlock:
        """Return a message; `origin` is the ROS time [ns] of time 0 of the plant."""
        if isinstance(measured, Packet):
            self._sent[measured.sensor] += 1
            block, rate = self._block(measured), getattr(self._sensors, measured.sensor).rate
            self._stamp(block, origin, measured.first / rate)
            return block
        if isinstance(measured, OilReading):
            found = Temperature(temperature=measured.temperature - ZERO_CELSIUS)
        else:
            found = self._shafts(measured)
        self._stamp(found, origin, measured.time)
        return found

    def _shafts(self, reading: ShaftReading) -> JointState:
        fields = {
            field: [reading.values[f"{side}_{quantity}"] for side in _SIDES]
            for field, quantity in INTERFACES.items()
        }
        return JointState(name=list(self._joints), position=list(reading.angles), **fields)

    def _block(self, packet: Packet) -> EncoderBlock | SampledBlock:
        errors = getattr(self._sensors, packet.sensor)
        common = {"sequence": self._sent[packet.sensor], "sample_period": 1.0 / errors.rate}
        if packet.sensor == "encoders":
            counts = 2**errors.bits
            block = EncoderBlock(
                first_sample=packet.first,
                input_counts_per_turn=counts,
                output_counts_per_turn=counts,
                **common,
            )
            block.input_counts, block.output_counts = packet.values.T.tolist()
            return block
        units = SAMPLED[packet.sensor].units
        block = SampledBlock(names=list(units), units=list(units.values()), **common)
        block.samples = packet.values.T.ravel().tolist()
        return block

    def _stamp(self, message: Any, origin: int, seconds: float) -> None:
        message.header.frame_id = self._frame
        set_stamp(message.header.stamp, origin + round(seconds * 1e9))
