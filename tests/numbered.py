"""Numbered messages in bags, and a reader of them that shares no code with the writer."""

import struct
from pathlib import Path

from mcap.records import Channel, Message
from mcap.stream_reader import StreamReader

from planetary_twin_py.recording.container.storage import Storage
from planetary_twin_py.recording.ros2.bag import BagWriter
from planetary_twin_py.recording.ros2.metadata import Topic

START = 1_790_000_000_000_000_000  # [ns]
PERIOD = 1_000_000  # [ns]
COMPRESSIONS = ("zstd", "lz4", "none")
QOS = {
    "history": "keep_last",
    "depth": 10,
    "reliability": "reliable",
    "durability": "volatile",
    "deadline": {"sec": 9223372036, "nsec": 854775807},
    "lifespan": {"sec": 9223372036, "nsec": 854775807},
    "liveliness": "automatic",
    "liveliness_lease_duration": {"sec": 9223372036, "nsec": 854775807},
    "avoid_ros_namespace_conventions": False,
}
LATCHED = QOS | {"durability": "transient_local", "depth": 1}
NUMBERS = Topic("/numbers", "demo_msgs/msg/Number", "RIHS01_00", "float64 data\n", [QOS])
SETTINGS = Topic("/settings", "demo_msgs/msg/Number", "RIHS01_00", "float64 data\n", [LATCHED])


def payload(value: float, size: int = 0) -> bytes:
    """A serialised Number, with so many bytes behind it."""
    return b"\x00\x01\x00\x00" + struct.pack("<d", value) + bytes(size)


def number_of(data: bytes) -> int:
    return round(struct.unpack_from("<d", data, 4)[0])


class Numbered:
    """A bag with one message of /numbers each millisecond, and /settings on request."""

    def __init__(self, folder: Path, storage: Storage | None = None, size: int = 0) -> None:
        self.bag = BagWriter(folder, storage)
        self._numbers = self.bag.add_topic(NUMBERS)
        self._settings = self.bag.add_topic(SETTINGS)
        self._size = size
        self.written = 0

    def write(self, count: int) -> None:
        for _ in range(count):
            self.written += 1
            self._write(self._numbers, self.written, self.written)

    def settle(self, value: int) -> None:
        self._write(self._settings, value, value)

    def _write(self, channel: int, value: int, sequence: int) -> None:
        time = START + self.written * PERIOD
        self.bag.write(channel, payload(value, self._size), time, time - 1000, sequence)


def read_numbers(file: Path, topic: str = "/numbers") -> list[int]:
    """Numbers in a file, also in a truncated one, up to the damage."""
    found: list[int] = []
    names: dict[int, str] = {}
    with file.open("rb") as stream:
        try:
            for record in StreamReader(stream, validate_crcs=True).records:
                if isinstance(record, Channel):
                    names[record.id] = record.topic
                elif isinstance(record, Message) and names[record.channel_id] == topic:
                    found.append(number_of(record.data))
        except Exception:  # whatever the library raises at a truncated record
            return found
    return found
