"""Measures the highest rate that the logger records without loss, its cost and its latency."""

from __future__ import annotations

import itertools
import os
import struct
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

import numpy as np
from mcap.writer import Writer
from planetary_twin.clients.client import Client
from planetary_twin.clients.loopback import stay_on_this_machine
from planetary_twin.running.node_process import Child, RunError
from planetary_twin_msgs.msg import RecorderStatus
from rclpy.qos import QoSProfile
from std_msgs.msg import String

from .figures import Quantiles
from .process import processor_time
from .tail import Tail

SIZES = (100, 1_000, 100_000)  # bytes
_SLOWEST = {100: 500.0, 1_000: 500.0, 100_000: 50.0}  # [Hz] first rate of the search
_BISECTIONS = 3  # of the interval that contains the highest rate
_START = 60.0  # [s]
_FLUSH_PERIOD = 0.5  # [s]
_DRAIN = 0.3  # [s] beyond the flush period; a logger that needs longer has not kept up
_TIMEOUT = 30.0  # [s]
_DEPTH = 1000
_BARE_MEGABYTES = 100.0
_HEADER = 8  # bytes of encapsulation and length
Progress = Callable[[str], None]


class Trial(NamedTuple):
    """The result for one rate."""

    rate: float  # [Hz] as sent
    lost: int
    behind: float  # [s] from the last message sent to the last one in the file
    cores: float  # share of one core used by the logger
    latency: Quantiles  # [s] from a message to its chunk in the file, of the oldest in each chunk

    @property
    def sustained(self) -> bool:
        """Whether the logger keeps up with this rate without loss."""
        return not self.lost and self.behind < _FLUSH_PERIOD + _DRAIN


class Throughput(NamedTuple):
    """The result for one message size."""

    size: int  # bytes
    best: Trial  # highest rate sustained
    limit: str  # what limits the rate
    bare_rate: float  # [Hz] of the mcap writer alone

    @property
    def megabytes(self) -> float:
        """Return the recorded megabytes per second."""
        return self.best.rate * self.size * 1e-6


def measure(duration: float, directory: Path, progress: Progress) -> list[Throughput]:
    """
    Measure every message size on the disk of `directory` and return the results.

    Each rate is sent for `duration` [s]. `progress` receives a line of text for each step.
    """
    stay_on_this_machine()
    return [_throughput(size, duration, directory, progress) for size in SIZES]


def _throughput(size: int, duration: float, directory: Path, progress: Progress) -> Throughput:
    with tempfile.TemporaryDirectory(dir=directory) as place:
        progress(f"{size} bytes: the mcap writer alone")
        bare = bare_rate(size, Path(place) / "bare.mcap")
    low, high, limit = None, None, "the logger"
    rate = _SLOWEST[size]
    for step in itertools.count():
        progress(f"{size} bytes: {rate:.0f} messages a second")
        with tempfile.TemporaryDirectory(dir=directory) as place:
            trial = run_trial(size, rate, duration, Path(place))
        if trial.sustained:
            low = trial if low is None or trial.rate > low.rate else low
            if trial.rate < 0.9 * rate:
                limit = "the sender"
                break
        else:
            high = rate
        if low is None and step == 2:
            raise RunError(f"{size} bytes: not even {rate:g} messages a second are recorded")
        if high is None:
            rate *= 2.0
        elif low is None:
            rate *= 0.5
        else:
            if high / low.rate < 2.0 ** (1.0 / 2**_BISECTIONS) or step > 16:
                break
            rate = (low.rate * high) ** 0.5
    assert low is not None
    return Throughput(size, low, limit, bare)


def run_trial(size: int, rate: float, duration: float, directory: Path) -> Trial:
    """Send messages of `size` bytes at `rate` [Hz] for `duration` [s] to a logger."""
    namespace = f"/bench_{os.getpid()}"
    parameters = {
        "directory": directory,
        "name": "bag",
        "topics": "[numbers]",
        "flush_period": _FLUSH_PERIOD,
    }
    with Child("logger", namespace, parameters) as logger, _Sender(namespace, logger) as sender:
        sender.begin()
        with Tail(directory / "bag/bag_0.mcap") as tail:
            before, begin = processor_time(logger.pid), time.monotonic()
            count = sender.send(Payload(size), rate, duration)
            ended = time.monotonic()
            sender.wait(lambda: sender.accounted() >= count, _TIMEOUT)
            sender.wait(lambda: tail.messages >= sender.recorded(), _TIMEOUT)
            cores = (processor_time(logger.pid) - before) / (time.monotonic() - begin)
        return Trial(
            count / (ended - begin),
            count - tail.messages,
            tail.newest - ended,
            cores,
            Quantiles.of(tail.latencies),
        )


class _Sender(Client):
    """Publishes messages in the namespace of a logger, and receives its message counts."""

    def __init__(self, namespace: str, logger: Child) -> None:
        super().__init__("sender", namespace, logger.check)
        self._publisher = self.node.create_publisher(String, "numbers", QoSProfile(depth=_DEPTH))
        self._status = RecorderStatus()
        self.node.create_subscription(RecorderStatus, "logger/status", self._on_status, 10)

    def begin(self) -> None:
        """Wait until the logger has subscribed."""
        if not self.wait(lambda: self._status.topics, _START):
            raise RunError("logger: does not subscribe to the sender")

    def send(self, payload: Payload, rate: float, duration: float) -> int:
        """Publish at `rate` [Hz] for `duration` [s]; returns the number of messages."""
        begin, count = time.monotonic(), 0
        while (now := time.monotonic() - begin) < duration:
            if now * rate < count:
                time.sleep(min(count / rate - now, 1e-3))
                continue
            self._publisher.publish(payload[count])
            count += 1
        return count

    def recorded(self) -> int:
        """Return the number of messages that the logger reports as recorded."""
        return sum(self._status.recorded)

    def accounted(self) -> int:
        """Return the number of messages that the logger reports as recorded or lost."""
        return self.recorded() + sum(self._status.lost)

    def _on_status(self, status: RecorderStatus) -> None:
        self._status = status


class Payload:
    """Distinct serialised Strings of `size` bytes that compress as well as measured floats."""

    def __init__(self, size: int) -> None:
        # Longer than a chunk, so that no message occurs twice in a chunk.
        floats = np.random.default_rng(1).normal(size=1_000_000).astype(np.float32)
        self._text = floats.tobytes()
        self._length = size - _HEADER - 1
        self._header = b"\x00\x01\x00\x00" + struct.pack("<I", self._length + 1)

    def __getitem__(self, number: int) -> bytes:
        begin = number * self._length % (len(self._text) - self._length)
        end = begin + self._length
        return self._header + self._text[begin:end] + b"\0"


def bare_rate(size: int, file: Path) -> float:
    """Return the messages per second of the mcap writer alone, with `file` synced to the disk."""
    payload = Payload(size)
    count = min(round(_BARE_MEGABYTES * 1e6 / size), 200_000)
    with file.open("wb") as stream:
        writer = Writer(stream)
        writer.start()
        schema = writer.register_schema("std_msgs/msg/String", "ros2msg", b"string data")
        channel = writer.register_channel("/numbers", "cdr", schema)
        begin = time.monotonic()
        for number in range(count):
            writer.add_message(channel, number, payload[number], number, number)
        writer.finish()
        stream.flush()
        os.fsync(stream.fileno())
        return count / (time.monotonic() - begin)
