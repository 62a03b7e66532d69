"""Converts the measurements of a plant to messages."""

from __future__ import annotations

from typing import Any

from planetary_twin_msgs.msg import EncoderBlock, SampledBlock
from sensor_msgs.msg import JointState, Temperature

from planetary_twin_py.following.measured_messages import INTERFACES, ZERO_CELSIUS
from planetary_twin_py.plant.hidden import SensorErrors
from planetary_twin_py.plant.timeline import (
    AccelerationPacket,
    CountPacket,
    Measured,
    OilReading,
    ShaftReading,
)
from planetary_twin_py.plant.vibration import NAME

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
        self._blocks = self._accelerations = 0

    def message(
        self, measured: Measured, origin: int
    ) -> JointState | Temperature | EncoderBlock | SampledBlock:
        """Return a message; `origin` is the ROS time [ns] of time 0 of the plant."""
        if isinstance(measured, CountPacket):
            self._blocks += 1
            return self._block(measured, origin)
        if isinstance(measured, AccelerationPacket):
            self._accelerations += 1
            return self._acceleration(measured, origin)
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

    def _block(self, packet: CountPacket, origin: int) -> EncoderBlock:
        errors = self._sensors.encoders
        found = EncoderBlock(
            sequence=self._blocks,
            first_sample=packet.first,
            sample_period=1.0 / errors.rate,
            input_counts_per_turn=2**errors.bits,
            output_counts_per_turn=2**errors.bits,
        )
        found.input_counts, found.output_counts = (column.tolist() for column in packet.counts.T)
        self._stamp(found, origin, packet.first / errors.rate)
        return found

    def _acceleration(self, packet: AccelerationPacket, origin: int) -> SampledBlock:
        found = SampledBlock(
            sequence=self._accelerations,
            sample_period=1.0 / self._sensors.vibration.rate,
            names=[NAME],
            units=["m/s^2"],
        )
        found.samples = packet.values.tolist()
        self._stamp(found, origin, packet.begin)
        return found

    def _stamp(self, message: Any, origin: int, seconds: float) -> None:
        message.header.frame_id = self._frame
        set_stamp(message.header.stamp, origin + round(seconds * 1e9))
