"""Publishes the measurements of a plant in real time."""

from __future__ import annotations

import math
import threading
import time
from collections.abc import Iterator
from typing import Any, Protocol

from planetary_twin_msgs.msg import EncoderBlock, SampledBlock
from sensor_msgs.msg import JointState, Temperature

from planetary_twin_py.following.channels.temperature import ZERO_CELSIUS
from planetary_twin_py.following.measured_messages import INTERFACES
from planetary_twin_py.plant.hidden import SensorErrors
from planetary_twin_py.plant.sampled import SAMPLED
from planetary_twin_py.plant.timeline import Measured, OilReading, Packet, ShaftReading

from ..base.clock import set_stamp

_SIDES = "input", "output"


class PlantNode(Protocol):
    """Node that publishes the messages of a plant."""

    def ready(self) -> bool:
        """Return whether the run may begin."""

    def now(self) -> int:
        """Return the ROS time [ns]."""

    def play(self, message: Any) -> None:
        """Publish a message."""

    def ended(self, defect: Exception | None) -> None:
        """Handle the end of the run; `defect` is the reason unless it is complete."""


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


class PlantPlayer:
    """Publishes each entry of `measured` at its time in a thread, starting with the first."""

    def __init__(
        self, measured: Iterator[Measured], messages: PlantMessages, node: PlantNode
    ) -> None:
        self._measured, self._messages, self._node = measured, messages, node
        self.played = 0.0
        """Time of the last published measurement [s]."""
        self._stop = threading.Event()
        self._thread = threading.Thread(target=self._run, name="plant", daemon=True)
        self._thread.start()

    def stop(self) -> None:
        """End the run."""
        self._stop.set()
        if self._thread is not threading.current_thread():
            self._thread.join()

    def _run(self) -> None:
        try:
            complete = self._play()
        except Exception as defect:
            self._node.ended(defect)
        else:
            if complete:
                self._node.ended(None)

    def _play(self) -> bool:
        """Publish all measurements; return False if `stop` is called before the end."""
        while not self._node.ready():
            if self._stop.wait(0.05):
                return False
        begin, origin = math.nan, 0
        for one in self._measured:
            if math.isnan(begin):
                begin, origin = (
                    time.monotonic() - one.time,
                    self._node.now() - round(one.time * 1e9),
                )
            message = self._messages.message(one, origin)
            if self._stop.wait(max(begin + one.time - time.monotonic(), 0.0)):
                return False
            self._node.play(message)
            self.played = one.time
        return True
