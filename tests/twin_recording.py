"""Writes what a twin shows as the node publishes it, without ROS; rows can be altered."""

import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
from mcap_ros2.writer import Writer
from synthetic_recording import START_NS, definition

import planetary_twin_py as pt
from planetary_twin_py.recording.fields import joint_fields, state_fields, waveform_fields
from planetary_twin_py.recording.origin import Makers, Origin, makers_here

NAMESPACE = "/planetary_twin"
_JOINTS = """std_msgs/Header header
string[] name
float64[] position
float64[] velocity
float64[] effort
"""
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

    def __init__(self, path: Path, alter: Alter = as_it_is, makers: Makers | None = None) -> None:
        self._stream = path.open("wb")
        self._writer = Writer(self._stream, chunk_size=64 * 1024)
        self._alter = alter
        self._makers = makers or makers_here()
        self._counts = dict.fromkeys(KINDS, 0)
        self._origin = START_NS
        self._schemas = {topic: self._schema(topic, kind) for topic, kind in KINDS.items()}

    def _schema(self, topic: str, kind: str) -> Any:
        name = kind.rpartition("/")[2]
        text = {"joint_states": _header(_JOINTS), "run_origin": "string data\n"}.get(topic)
        return self._writer.register_msgdef(kind, text or definition(name))

    def begin(self, twin: pt.Twin, stamp: int) -> None:
        """Let a run begin at ROS time `stamp` [ns]."""
        self._origin = stamp
        text = Origin(twin.scene, stamp, self._makers).text()
        self._write("run_origin", {"data": text}, twin.time)
        self.point(twin)

    def point(self, twin: pt.Twin) -> None:
        """Tell the operating point in force."""
        values = twin.operating_point.model_dump()
        row = {"simulated_time": twin.time, "changed": "", **values}
        self._write("operating_point", row, twin.time)

    def advance(self, twin: pt.Twin, duration: float) -> None:
        """Run on, and tell of it."""
        window = twin.advance(duration)
        names = [line.split()[1] for line in definition("GearboxState").splitlines()
                 if line and line[0] not in "#=M" and len(line.split()) > 1]  # fmt: skip
        shown = {name: _plain(value) for name, value in state_fields(window, names).items()}
        chosen = {"tolerance": window.tolerance, "sample_rate": window.sample_rate}
        self._write("gearbox_state", shown | chosen, window.end)
        joints = {name: _plain(value) for name, value in joint_fields(window).items()}
        names = [f"{body}_joint" for body in window.bodies]
        self._write("joint_states", {"name": names, "effort": [], **joints}, window.end)
        if len(window.waveform.time):
            wave = waveform_fields(window)
            row = {name: _plain(value) for name, value in wave.items()}
            self._write("mesh_waveform", row, float(wave["start_time"]))

    def finish(self) -> None:
        """Close the file."""
        self._writer.finish()
        self._stream.close()

    def _write(self, topic: str, row: Row, time: float) -> None:
        self._counts[topic] += 1
        number = self._counts[topic]
        stamp = self._origin + round(time * 1e9)
        header = {"stamp": {"sec": stamp // 10**9, "nanosec": stamp % 10**9}, "frame_id": "gearbox"}
        told = self._alter(topic, number, {"header": header, "sequence": number, **row})
        if told is not None:
            self._writer.write_message(
                f"{NAMESPACE}/{topic}", self._schemas[topic], told, stamp, stamp, number
            )


def _header(text: str) -> str:
    return text + definition("GearboxState").partition("=" * 80)[1] + _dependencies()


def _dependencies() -> str:
    return definition("GearboxState").partition("=" * 80)[2]


def _plain(value: Any) -> Any:
    return value.tolist() if isinstance(value, np.ndarray) else value


def record(path: Path, alter: Alter = as_it_is, makers: Makers | None = None) -> Path:
    """Two runs with every kind of change: 30 intervals, then 10 after a reset."""
    scene = pt.load_scene("paper")
    recording = TwinRecording(path, alter, makers)
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
    return path
