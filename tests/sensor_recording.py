"""Writes recordings with blocks of samples, which can be altered, of a twin or of a device."""

from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np
from twin_recording import NAMESPACE, START_NS, TwinRecording

import planetary_twin_py as pt
from planetary_twin_py.recording.ros2.bag import BagWriter, write_as
from planetary_twin_py.recording.ros2.definitions import topic_of
from planetary_twin_py.recording.ros2.sensor_topics import SAMPLED
from planetary_twin_py.recording.ros2.typestore import types_of

RATE = 25_600.0  # [Hz]
BLOCK = 256  # samples
TOPIC = f"{NAMESPACE}/sensors/ring_top"
Alter = Callable[[int], Sequence[int]]
"""Numbers under which block `number`, from 1, is written: none, itself, or several."""


def as_it_is(number: int) -> Sequence[int]:
    return (number,)


class BlockWriter:
    """Writes `SampledBlock` messages to a bag."""

    def __init__(self, bag: BagWriter, topic: str, units: dict[str, str]) -> None:
        described = topic_of(topic, SAMPLED)
        self._bag, self._units = bag, units
        self._channel = bag.add_topic(described)
        self._types = types_of(described.definition.encode(), SAMPLED)

    def write(self, number: int, stamp: int, samples: np.ndarray, rate: float = RATE) -> None:
        """Write samples (n, channels) whose first has this stamp [ns]."""
        types = self._types.types
        time = types["builtin_interfaces/msg/Time"](*divmod(stamp, 1_000_000_000))
        message = types[SAMPLED](
            header=types["std_msgs/msg/Header"](time, "gearbox"),
            sequence=number,
            sample_period=1.0 / rate,
            names=list(self._units),
            units=list(self._units.values()),
            samples=samples.T.ravel().astype(np.float32),
        )
        data = bytes(self._types.serialize_cdr(message, SAMPLED))
        end = stamp + round(1e9 * len(samples) / rate)
        self._bag.write(self._channel, data, end, end, number)


def record_twin(
    out: Path, alter: Alter = as_it_is, duration: float = 1.0, unit: str = "m/s^2"
) -> Path:
    """A run of `paper`, and an accelerometer that reads 3 at its mesh frequency."""

    def write(folder: Path) -> Path:
        recording = TwinRecording(folder)
        twin = pt.Twin(pt.load_scene("paper"), 1000.0, 1e-3)
        blocks = BlockWriter(recording._bag, TOPIC, {"ring_top": unit})
        recording.begin(twin, START_NS)
        mesh = pt.Twin(twin.scene).advance(0.01).mesh_frequency
        noise = np.random.default_rng(1)
        for number in range(1, round(duration / 0.01) + 1):
            recording.advance(twin, 0.01)
            time = (BLOCK * (number - 1) + np.arange(BLOCK)) / RATE
            samples = 3.0 * np.cos(2.0 * np.pi * mesh * time) + 0.01 * noise.standard_normal(BLOCK)
            for written in alter(number):
                stamp = START_NS + round(1e9 * time[0])
                blocks.write(written, stamp, samples[:, None])
        recording.finish()
        return recording.file

    return write_as(out, write)


def record_device(
    out: Path,
    samples: np.ndarray,
    units: dict[str, str],
    alter: Alter = as_it_is,
    topic: str = "/rig/vibration",
) -> Path:
    """Samples (n, channels) of a device without a twin, in blocks."""

    def write(folder: Path) -> Path:
        bag = BagWriter(folder)
        blocks = BlockWriter(bag, topic, units)
        for number, first in enumerate(range(0, len(samples), BLOCK), 1):
            for written in alter(number):
                stamp = START_NS + round(1e9 * first / RATE)
                blocks.write(written, stamp, samples[first : first + BLOCK])
        bag.close()
        return bag.file

    return write_as(out, write)
