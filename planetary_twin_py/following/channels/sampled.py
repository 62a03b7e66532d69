"""Devices that send many samples at a time, in one list.

The name of a device is that of its file in `following/devices/`, which reads and follows its
samples, and of its file in `plant/`, which simulates them.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, NamedTuple, Protocol

from ...recording.ros2.sensor_topics import ENCODERS, SAMPLED

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

SAMPLE, COUNTS = "sample", ("input_counts", "output_counts")


class Samples(Protocol):
    """Samples of a device in the order of their arrival."""

    @property
    def device(self) -> str:
        """Name of the device in `DEVICES`."""

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the channels."""

    def stamps(self) -> NDArray[np.float64]:
        """Stamps [s], (n,)."""

    def part(self, rows: slice) -> Samples:
        """Some of the samples."""


class SampledMessages(Protocol):
    """Converts the messages of one sender in the order of their arrival."""

    def unused(self, block: Any) -> str:
        """Why a message is not used; empty if it is."""

    def read(self, sender: str, block: Any) -> Any:
        """Convert a message of a sender to samples; raises `InputError` if it does not fit."""

    def join(self, blocks: Sequence[Any]) -> Any:
        """Join successive samples."""


class Device(NamedTuple):
    """A device: what its options, its topic and the tables of others need of it."""

    name: str
    """Also of its options, of its errors, and of its topic below `measured`."""
    message: str
    """Type of its messages."""
    sensors: str
    """Its sensors, after "samples of"."""
    table: str
    """What a table of its samples is."""
    columns: tuple[str, ...] = ()
    """Fixed names of the columns of its tables, which no other device reads."""


DEVICES = {
    device.name: device
    for device in (
        Device(
            "encoders", ENCODERS, "both encoders",
            "Samples of two encoders: a table with the columns sample (or time), input_counts and "
            "output_counts.",
            (SAMPLE, *COUNTS),
        ),
        Device(
            "vibration", SAMPLED, "the accelerometer",
            "Samples of accelerometers: a table with the column time and one for each sensor; may "
            "be the table of --from.",
        ),
    )
}  # fmt: skip
"""All devices by name. The first that uses a message reads it, and vibration has any unit."""
MESSAGES = tuple(dict.fromkeys(device.message for device in DEVICES.values()))
"""Types of messages that have many samples."""
