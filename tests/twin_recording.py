"""Writes what a twin shows as the node publishes it, without ROS; rows can be altered."""

import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
from numbered import LATCHED, QOS
from rosbags.typesys import Stores, get_types_from_msg, get_typestore
from synthetic_recording import START_NS, definition

import planetary_twin_py as pt
from planetary_twin_py.recording.bag import BagWriter
from planetary_twin_py.recording.fields import joint_fields, state_fields, waveform_fields
from planetary_twin_py.recording.origin import Makers, Origin, makers_here
from planetary_twin_py.recording.rosbag2 import Topic
from planetary_twin_py.recording.storage import Storage

NAMESPACE = "/planetary_twin"
KINDS = {
    "gearbox_state": "planetary_twin_msgs/msg/GearboxState",
    "mesh_waveform": "planetary_twin_msgs/msg/MeshWaveform",
    "operating_point": "planetary_twin_msgs/msg/OperatingPoint",
    "joint_states": "sensor_msgs/msg/JointState",
    "run_origin": "std_msgs/msg/String",
}
Row = dict[str, Any]
Alter = Callable[[str, int, Row], Row | None]


def as_it_is(topic: str, number: int, row: Row) -> Row | None:
    """Row `number` of a topic, counted from 1; None leaves it out."""
    return row


class TwinRecording:
    """A recording in the making."""

    def __init__(
        self,
        folder: Path,
        alter: Alter = as_it_is,
        makers: Makers | None = None,
        storage: Storage | None = None,
    ) -> None:
        self._bag = BagWriter(folder, storage)
        self.file = self._bag.file
        self._alter = alter
        self._makers = makers or makers_here()
        self._counts = dict.fromkeys(KINDS, 0)
        self._origin = START_NS
        self._types = get_typestore(Stores.ROS2_JAZZY)
        self._channels = {topic: self._channel(topic, kind) for topic, kind in KINDS.items()}

    def _channel(self, topic: str, kind: str) -> int:
        name = kind.rpartition("/")[2]
        if kind.startswith("planetary_twin_msgs"):
            text = definition(name)
            found = get_types_from_msg(text, kind)
            self._types.register({k: v for k, v in found.items() if k not in self._types.types})
        else:
            text, _ = self._types.generate_msgdef(kind)
        latched = kind.endswith(("OperatingPoint", "String"))
        qos = [LATCHED if latched else QOS]
        return self._bag.add_topic(Topic(f"{NAMESPACE}/{topic}", kind, "RIHS01_", text, qos))

    def begin(self, twin: pt.Twin, stamp: int) -> None:
        """Let a run begin at ROS time `stamp` [ns]."""
        self._origin = stamp
        self._write("run_origin", {"data": Origin(twin.scene, stamp, self._makers).text()}, 0.0)
        self.point(twin)

    def point(self, twin: pt.Twin) -> None:
        """Tell the operating point in force."""
        values = twin.operating_point.model_dump()
        row = {"simulated_time": twin.time, "changed": "", **values}
        self._write("operating_point", row, twin.time)

    def advance(self, twin: pt.Twin, duration: float) -> None:
        """Run on, and tell of it."""
        if self._counts["gearbox_state"] % 10 == 0:
            self._bag.flush()  # as a timer would
        window = twin.advance(duration)
        shown = state_fields(window, list(self._fields("gearbox_state")))
        chosen = {"tolerance": window.tolerance, "sample_rate": window.sample_rate}
        self._write("gearbox_state", shown | chosen, window.end)
        names = {"name": [f"{body}_joint" for body in window.bodies], "effort": np.empty(0)}
        self._write("joint_states", names | joint_fields(window), window.end)
        if len(window.waveform.time):
            wave = waveform_fields(window)
            self._write("mesh_waveform", wave, wave["start_time"])

    def finish(self) -> None:
        """Close the file."""
        self._bag.close()

    def _fields(self, topic: str) -> Any:
        return self._types.types[KINDS[topic]].__dataclass_fields__

    def _write(self, topic: str, row: Row, time: float) -> None:
        self._counts[topic] += 1
        number = self._counts[topic]
        stamp = self._origin + round(time * 1e9)
        told = self._alter(topic, number, row)
        if told is None:
            return
        if "header" in self._fields(topic):
            sec, nanosec = divmod(stamp, 10**9)
            types = self._types.types
            told = {
                "header": types["std_msgs/msg/Header"](
                    types["builtin_interfaces/msg/Time"](sec, nanosec), "gearbox"
                ),
                **told,
            }
        if "sequence" in self._fields(topic):
            told = {"sequence": number, **told}
        message = self._types.types[KINDS[topic]](**told)
        data = bytes(self._types.serialize_cdr(message, KINDS[topic]))
        self._bag.write(self._channels[topic], data, stamp, stamp, number)


def record(
    folder: Path,
    alter: Alter = as_it_is,
    makers: Makers | None = None,
    storage: Storage | None = None,
) -> Path:
    """Two runs with every kind of change: 31 intervals, then 10 after a reset; the file's path."""
    scene = pt.load_scene("paper")
    recording = TwinRecording(folder, alter, makers, storage)
    twin = pt.Twin(scene, 10_000.0, 1e-3)
    recording.begin(twin, START_NS)
    for number in range(1, 31):
        recording.advance(twin, 0.01)
        if number == 10:
            twin.set(backlash=3e-7, lambda_ratio=1.5)
            recording.point(twin)
        elif number == 15:
            twin.set_tolerance(1e-2)
        elif number == 20:
            twin.set_sample_rate(5_000.0)
    recording.advance(twin, 0.0001)  # a step shorter than the sample period
    twin = pt.Twin(scene.replace(input_speed=150.0), 10_000.0, 1e-3)
    recording.begin(twin, START_NS + math.ceil(1e9))
    for _ in range(10):
        recording.advance(twin, 0.01)
    recording.finish()
    return recording.file
