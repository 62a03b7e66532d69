"""Writes windows of a twin to a bag, as the messages that the nodes publish; needs no ROS."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import yaml

from ...durability.damage_state import Replacement
from ...durability.run_damage import RunDamage
from ...model.clock import TICKS
from ...robot import frame_of, robot_description
from ...run.steady_temperatures import with_start
from ...run.warming import start_temperatures
from ...run.window import Window
from ...scene import Scene
from ...scene.live import FAULTS
from ..container.records import RecordingError
from ..ros2.axes_fields import axes_state_fields, axes_waveform_fields
from ..ros2.bag import BagWriter
from ..ros2.definitions import KINDS
from ..ros2.fields import joint_fields, state_fields, waveform_fields
from ..ros2.given import FIELDS, fields_of
from ..ros2.metadata import Topic
from ..ros2.point import point_fields
from ..ros2.sensor_messages import SensorMessages
from ..ros2.sensor_topics import OF_TEMPERATURES, SENSORS, levels_topic, sensor_topic
from ..ros2.topics import (
    AXES_STATE,
    AXES_WAVEFORM,
    DESCRIPTION,
    GIVEN,
    JOINTS,
    ORIGIN,
    POINT,
    STATE,
    WAVEFORM,
)
from ..ros2.typestore import types_of
from .origin import Measured, Origin, damage_at
from .reader import SCENE_ATTACHMENT
from .schedule import nanoseconds

Row = dict[str, Any]
_PAUSE = 1_000_000_000  # [ns], larger differences of stamps and simulated time are pauses


class Composer:
    """Writes windows and operating points as messages.

    Args:
        bag: where to write.
        topics: topics to write; topics that are not of the twin are ignored.
        namespace: namespace of the twin.
        frame: name of the base frame of the gearbox.
    """

    def __init__(
        self, bag: BagWriter, topics: Iterable[Topic], namespace: str, frame: str = "gearbox"
    ) -> None:
        self._bag = bag
        self._frame = frame
        own = (*KINDS, GIVEN, *OF_TEMPERATURES)
        written = {
            name: topic
            for topic in topics
            if (name := topic.name.removeprefix(f"{namespace}/")) in own
            or topic.name.startswith(f"{namespace}/{SENSORS}/")
        }
        self._channels = {name: bag.add_topic(topic) for name, topic in written.items()}
        self._kinds = {name: topic.type for name, topic in written.items()}
        self._types = {
            name: types_of(topic.definition.encode(), topic.type) for name, topic in written.items()
        }
        self._counts = dict.fromkeys(self._kinds, 0)
        self._last: Mapping[str, Any] | None = None
        self._sensors: SensorMessages | None = None
        self._oil: float | None = None  # its temperature [K], if it is a state
        self._frames: dict[str, str] = {}  # of sensors
        self._damage: RunDamage | None = None

    def begin(self, origin: Origin) -> None:
        """Write the origin and the robot description at the start of a run."""
        self._sensors = SensorMessages(origin.scene)
        self._damage = damage_at(origin)
        if origin.scene.thermal is not None and not isinstance(origin.makers, Measured):
            self._oil = float(start_temperatures(with_start(origin.scene))[0])
        self._frames = {
            topic: frame_of(sensor, self._frame)
            for sensor in origin.scene.sensors
            for topic in (sensor_topic(sensor.name), levels_topic(sensor.name))
        }
        self.write(ORIGIN, {"data": origin.text()}, origin.begins, origin.begins)
        if DESCRIPTION in self._kinds:
            scene = origin.scene
            text = robot_description(scene.gearset, self._frame, scene.sensors)
            self.write(DESCRIPTION, {"data": text}, origin.begins, origin.begins)

    def replace_parts(self, replacements: Iterable[Replacement]) -> None:
        """Set the damage of parts that are replaced now to 0."""
        if self._damage is None:
            return
        for entry in replacements:
            self._damage.replace_part(entry.part, entry.time)

    def point(
        self,
        values: Mapping[str, Any],
        time: float,
        stamp: int,
        worsened: Iterable[str] | None = None,
    ) -> None:
        """Write operating point and ports, with the present temperature of the oil.

        Args:
            values: by the arguments of `Twin.set`.
            time: simulated time from which they apply [s].
            stamp: the same in ROS time [ns].
            worsened: names of the severities that are set; None: all in `values`.
        """
        if worsened is None:
            worsened = [name for name in values if name.startswith(FAULTS)]
        row = {"simulated_time": time, **point_fields(values, self._last, worsened, self._oil)}
        self._last = values
        self.write(POINT, row, stamp, stamp)

    def window(self, window: Window, stamps: Stamps) -> None:
        """Write the messages of a window.

        Args:
            window: window of the twin.
            stamps: ROS times of its interval.
        """
        stamp = stamps.stamp
        if window.given:
            self.write(GIVEN, self._given(window), stamp, stamp)
        self.write(STATE, self._state(window), stamp, stamp)
        names = [f"{body}_joint" for body in window.bodies]
        joints = {"name": names, **joint_fields(window)}
        self.write(JOINTS, joints, stamp, stamp)
        sampled = len(window.waveform.time)
        first = stamps.of(window.waveform.time[0]) if sampled else stamp
        if window.axes is not None:
            self.write(AXES_STATE, axes_state_fields(window), stamp, stamp)
            if sampled:
                self.write(AXES_WAVEFORM, axes_waveform_fields(window), first, stamp)
        if sampled:
            self.write(WAVEFORM, waveform_fields(window), first, stamp)
        if self._damage is not None and window.damage is not None:
            self._damage.add(window.damage)
            for topic, row in self._damage.messages(window.start, window.end).items():
                self.write(topic, row, stamp, stamp)
        for topic, time, fields in self._sensors.of(window) if self._sensors else ():
            self.write(topic, fields, stamps.of(time), stamp)
        self._oil = window.temperatures.get("oil")

    def write(self, topic: str, row: Row, stamp: int, sent: int) -> None:
        """Write the next message of a topic, if it is one of the topics to write.

        Args:
            topic: name without namespace.
            row: fields.
            stamp: time in the header [ns].
            sent: publish time [ns].
        """
        if topic not in self._kinds:
            return
        self._counts[topic] += 1
        number = self._counts[topic]
        message = self._message(topic, {"sequence": number, **row}, stamp)
        data = bytes(self._types[topic].serialize_cdr(message, self._kinds[topic]))
        self._bag.write(self._channels[topic], data, sent, sent, number)

    def _given(self, window: Window) -> Row:
        """Fields of the commands at the ports in a window."""
        input_joint, output_joint = (f"{window.bodies[body]}_joint" for body in window.members[:2])
        fields = fields_of(window.given, (input_joint, output_joint))
        return fields | {field: np.array(fields[field], dtype=float) for field in FIELDS}

    def _state(self, window: Window) -> Row:
        if STATE not in self._kinds:
            return {}
        setting = {"tolerance": window.tolerance, "sample_rate": window.sample_rate}
        return state_fields(window, self._fields(STATE)) | setting

    def _message(self, topic: str, row: Row, stamp: int) -> Any:
        types = self._types[topic].types
        if "header" in self._fields(topic):
            time = types["builtin_interfaces/msg/Time"](*divmod(stamp, 1_000_000_000))
            # JointState has no frame.
            frame = "" if topic in (JOINTS, GIVEN) else self._frames.get(topic, self._frame)
            row = {"header": types["std_msgs/msg/Header"](time, frame), **row}
        unknown = [name for name in self._fields(topic) if name not in row]
        if unknown:
            kind = self._kinds[topic]
            raise RecordingError(f"{kind}.{unknown[0]}: unknown field")
        return types[self._kinds[topic]](**{name: row[name] for name in self._fields(topic)})

    def _fields(self, topic: str) -> list[str]:
        return [name for name, _ in self._types[topic].fielddefs[self._kinds[topic]][1]]


@contextmanager
def new_bag(folder: Path, scene: Scene, attached: int | None = None) -> Iterator[BagWriter]:
    """A bag with a scene; what is written before an error is a valid recording, too.

    Args:
        folder: to be created.
        scene: at the start of the run.
        attached: time of the attachments [ns]; None: now.
    """
    bag = BagWriter(folder, attached=attached)
    try:
        attach_yaml(bag, SCENE_ATTACHMENT, scene.model_dump(mode="json"))
        yield bag
    finally:
        bag.close()


def attach_yaml(bag: BagWriter, name: str, content: Mapping[str, Any]) -> None:
    """Attach a mapping."""
    bag.attach(name, yaml.safe_dump(content, sort_keys=False).encode(), "application/yaml")


class Stamps(NamedTuple):
    """ROS times of an interval, as in the nodes."""

    begin: int
    """Its start [ticks]."""
    end: int
    """Its end [ticks]."""
    before: int
    """ROS time of the end of the interval before [ns]."""
    stamp: int
    """ROS time of its end [ns]."""

    def of(self, time: float) -> int:
        """ROS time of a simulated time [s], in the interval or shortly before [ns]."""
        span = self.stamp - self.before
        paused = span - nanoseconds(self.end - self.begin) > _PAUSE
        pace = 1e9 if paused else span / (self.end / TICKS - self.begin / TICKS)
        return int(self.stamp + round((time - self.end / TICKS) * pace))
