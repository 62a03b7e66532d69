"""A comparison of recorded values with those of a simulation."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import asdict, dataclass, field
from typing import Any, NamedTuple

import numpy as np

from ...run.window import Window
from ..ros2.axes_fields import largest_of_kind
from ..ros2.topics import AXES_STATE
from .intervals import Interval

BOUND = 10.0  # allowed difference between machines in tolerances; each has errors of up to 3


class Difference(NamedTuple):
    """A recorded value that differs from the simulated one."""

    time: float  # simulated [s], of the end of its interval
    topic: str
    field: str
    place: int  # in an array
    recorded: float
    simulated: float


@dataclass
class Comparison:
    """Result of a comparison; `remarks` are warnings about parts that were not compared."""

    same_makers: bool = True
    """Whether the same core on the same type of machine made the recording."""
    messages: dict[str, int] = field(default_factory=dict)
    """Number of compared messages by topic."""
    left_out: int = 0
    """Number of messages that could not be compared."""
    not_recorded: int = 0
    """Number of intervals without a recorded state."""
    values: int = 0
    first_difference: Difference | None = None
    largest: float = 0.0
    """Largest difference, divided by the largest value of its array (stored power: or of the input
    power) and by the tolerance."""
    remarks: list[str] = field(default_factory=list)
    ledger: str | None = None
    """Warning if the energy ledger of the compared intervals does not balance."""
    accuracy: list[str] = field(default_factory=list)
    """Warnings about values that are less accurate than the tolerance, a line each."""

    @property
    def identical(self) -> bool:
        """Whether everything was compared and is identical bit for bit."""
        return self.first_difference is None and not self.remarks

    @property
    def within_bound(self) -> bool:
        """Whether the differences are within the bound for different machines."""
        return self.largest <= BOUND and not self.remarks

    @property
    def conclusion(self) -> str:
        """The verdict; `remarks` state why not everything was compared."""
        same = sum(self.messages.values())
        if self.identical and self.not_recorded:
            return f"{same} recorded messages, all identical bit for bit"
        if self.identical:
            return "identical bit for bit"
        if self.first_difference:
            return self._differing()
        if self.left_out:
            return (
                f"identical bit for bit in {same} of {same + self.left_out} messages; "
                "the others could not be compared, see the warnings"
            )
        return (
            f"{same} messages read, all identical bit for bit; "
            "but the recording is incomplete, see the warnings"
        )

    def _differing(self) -> str:
        if self.same_makers:
            return "differs, although the same core on the same type of machine recorded it"
        if self.largest > BOUND:
            return "differs by more than the bound between machines"
        incomplete = "; but the recording is incomplete, see the warnings" if self.remarks else ""
        return f"within the bound between machines{incomplete}"

    def lines(self) -> Iterator[tuple[str, str]]:
        """What was compared and found: label and text."""
        counts = ", ".join(f"{count} {topic}" for topic, count in self.messages.items())
        yield "compared", f"{counts}: {self.values} values"
        if self.not_recorded:
            yield "not recorded", f"{self.not_recorded} states"
        if not self.same_makers:
            yield "recorded by", "another core or another type of machine"
        if first := self.first_difference:
            yield (
                "first difference",
                f"{first.topic}.{first.field}[{first.place}] at {first.time:.9g} s: "
                f"recorded {first.recorded!r}, simulated {first.simulated!r}",
            )
            yield "largest", f"{self.largest:.3g} x tolerance (bound between machines: {BOUND:g})"
        yield "result", self.conclusion

    def figures(self) -> dict[str, Any]:
        """The comparison for JSON."""
        figures = asdict(self)
        del figures["left_out"]
        first = self.first_difference
        return figures | {
            "identical": self.identical,
            "first_difference": None if first is None else first._asdict(),
            "within_bound": self.within_bound,
            "largest_difference": figures.pop("largest"),
        }


def compare_fields(
    result: Comparison,
    topic: str,
    message: Any,
    expected: Mapping[str, Any],
    interval: Interval,
    window: Window,
) -> None:
    """Compare fields of a message, and add the result.

    Args:
        result: is increased.
        topic: of the message.
        message: as recorded.
        expected: simulated fields by name.
        interval: of the message.
        window: the same, simulated.
    """
    result.messages[topic] = result.messages.get(topic, 0) + 1
    for name, simulated in expected.items():
        recorded = np.asarray(getattr(message, name))
        simulated = np.asarray(simulated, recorded.dtype)
        result.values += recorded.size
        if recorded.tobytes() == simulated.tobytes():
            continue
        recorded, simulated = np.atleast_1d(recorded), np.atleast_1d(simulated)
        size = _size_beside(topic, message, name)
        distance = _distance(recorded, simulated, size)
        result.largest = max(result.largest, distance / interval.tolerance)
        if result.first_difference is None:
            result.first_difference = _first(topic, name, window.end, recorded, simulated)


def _size_beside(topic: str, message: Any, name: str) -> float:
    """Size of the quantities whose small difference a field is; 0 for other fields."""
    if topic == AXES_STATE:
        return largest_of_kind(message, name)
    return abs(float(message.input_power)) if name == "stored_power" else 0.0


def _distance(recorded: np.ndarray, simulated: np.ndarray, least: float = 0.0) -> float:
    """Largest difference over the largest value, or over `least` if that is more.

    Infinite if only one of two values is finite.
    """
    if recorded.shape != simulated.shape:
        return float("inf")
    if not np.array_equal(np.isfinite(recorded), np.isfinite(simulated)):
        return float("inf")
    finite = np.isfinite(simulated)
    size = np.abs(simulated[finite]).max(initial=least)
    difference = np.abs(recorded[finite] - simulated[finite]).max(initial=0.0)
    return float(difference / size) if size > 0.0 else float("inf") if difference > 0.0 else 0.0


def _first(
    topic: str, name: str, time: float, recorded: np.ndarray, simulated: np.ndarray
) -> Difference:
    if recorded.shape != simulated.shape:
        return Difference(time, topic, f"{name} (length)", 0, recorded.size, simulated.size)
    differs = recorded.view(np.uint8).reshape(recorded.size, -1) != simulated.view(
        np.uint8
    ).reshape(simulated.size, -1)
    place = int(np.argmax(differs.any(axis=1)))
    return Difference(time, topic, name, place, float(recorded[place]), float(simulated[place]))
