"""Writes what a twin shows as the node publishes it, without ROS; rows can be altered."""

import math
from collections.abc import Callable, Container, Mapping
from pathlib import Path
from types import MappingProxyType
from typing import Any

from mcap.reader import make_reader
from mcap.records import ChunkIndex
from rosbags.highlevel import AnyReader

import planetary_twin_py as pt
from planetary_twin_py.model.clock import TICKS
from planetary_twin_py.recording.container.storage import Storage
from planetary_twin_py.recording.ros2.bag import BagWriter, write_as
from planetary_twin_py.recording.ros2.definitions import topics_of
from planetary_twin_py.recording.runs.compose import Composer, Row, Stamps
from planetary_twin_py.recording.runs.origin import Makers, Origin, makers_here

NAMESPACE = "/planetary_twin"
START_NS = 1_790_000_000_000_000_000
SAMPLE_RATE = 50_000.0
BLOCK = 500  # samples of an interval of `write_recording`
TOUR = {
    0.25: {"lambda_ratio": 1.5},
    0.5: {"lambda_ratio": 2.0, "input_speed": pt.rpm(2000.0)},
    0.75: {"backlash": 3.5e-7},
}
"""What changes in `write_recording`, by simulated time [s]."""
Alter = Callable[[str, int, Row], Row | None]


def as_it_is(topic: str, number: int, row: Row) -> Row | None:
    """Row `number` of a topic, counted from 1; None leaves it out."""
    return row


def without(topic: str, numbers: Container[int] | None = None) -> Alter:
    """Leave out messages of a topic: those with these numbers, or all."""
    return lambda at, number, row: (
        None if at == topic and (numbers is None or number in numbers) else row
    )


class Altering(Composer):
    """Alters what it writes."""

    def __init__(
        self, bag: BagWriter, alter: Alter, namespace: str, moving_axes: bool,
        sensors: Mapping[str, str],
    ) -> None:  # fmt: skip
        super().__init__(bag, topics_of(namespace, moving_axes, sensors=sensors), namespace)
        self._alter = alter

    def write(self, topic: str, row: Row, stamp: int, sent: int) -> None:
        """Write the next message of a topic, altered."""
        altered = self._alter(topic, self._counts[topic] + 1, row)
        if altered is None:
            self._counts[topic] += 1
        else:
            super().write(topic, altered, stamp, sent)


class TwinRecording:
    """A recording in the making."""

    def __init__(
        self,
        folder: Path,
        alter: Alter = as_it_is,
        makers: Makers | None = None,
        storage: Storage | None = None,
        namespace: str = NAMESPACE,
        sensors: Mapping[str, str] = MappingProxyType({}),
        moving_axes: bool = False,
    ) -> None:
        self._bag = BagWriter(folder, storage)
        self.file = self._bag.file
        self._composer = Altering(self._bag, alter, namespace, moving_axes, sensors)
        self._makers = makers or makers_here()
        self._origin = START_NS
        self._windows = 0

    def begin(self, twin: pt.Twin, stamp: int) -> None:
        """Let a run begin at ROS time `stamp` [ns]."""
        self._origin = stamp
        self._composer.begin(Origin(twin.scene, stamp, self._makers))
        self.point(twin)

    def point(self, twin: pt.Twin) -> None:
        """Write the operating point in force."""
        change = twin.log[-1]
        self._composer.point(change.values, twin.time, self._stamp(twin.time), change.worsened)

    def advance(self, twin: pt.Twin, duration: float) -> None:
        """Advance the twin and write its messages."""
        if self._windows % 10 == 0:
            self._bag.flush()  # as a timer would
        self._windows += 1
        window = twin.advance(duration)
        begin, end = (round(time * TICKS) for time in (window.start, window.end))
        stamps = Stamps(begin, end, self._stamp(window.start), self._stamp(window.end))
        self._composer.window(window, stamps)

    def finish(self) -> None:
        """Close the file."""
        self._bag.close()

    def _stamp(self, time: float) -> int:
        return self._origin + round(time * 1e9)


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


def write_recording(
    out: Path,
    duration: float = 1.0,
    alter: Alter = as_it_is,
    *,
    namespace: str = NAMESPACE,
    storage: Storage | None = None,
    sample_rate: float = SAMPLE_RATE,
) -> Path:
    """A run of `paper` with the changes of TOUR, in a folder or a file that ends in .mcap."""

    def write(folder: Path) -> Path:
        recording = TwinRecording(folder, alter, storage=storage, namespace=namespace)
        twin = pt.Twin(pt.load_scene("paper"), sample_rate, 1e-3)
        recording.begin(twin, START_NS)
        for number in range(round(duration / 0.01)):
            if number / 100 in TOUR:
                twin.set(**TOUR[number / 100])
                recording.point(twin)
            recording.advance(twin, 0.01)
        recording.finish()
        return recording.file

    return write_as(out, write)


def messages(file: Path) -> list[tuple[str, int, int, int, bytes]]:
    """Topic, time, number and bytes of every message, by a reader that uses the index."""
    with file.open("rb") as stream:
        return [
            (channel.topic, m.log_time, m.publish_time, m.sequence, m.data)
            for _, channel, m in make_reader(stream, validate_crcs=True).iter_messages()
        ]


def chunks(file: Path) -> list[ChunkIndex]:
    """The chunks of a file, by its own index."""
    with file.open("rb") as stream:
        return make_reader(stream).get_summary().chunk_indexes


def decoded(folder: Path, topic: str) -> list[Any]:
    """Messages of a topic, decoded by rosbags."""
    with AnyReader([folder]) as bag:
        wanted = [one for one in bag.connections if one.topic == topic]
        found = bag.messages(wanted) if wanted else ()  # without a topic it reads all
        return [bag.deserialize(raw, one.msgtype) for one, _, raw in found]
