"""Simulates a recording again and compares every value."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Iterator, Mapping
from dataclasses import asdict, dataclass, field, fields
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from ...checks.accuracy import course_warnings
from ...checks.ledger import Balance, balance_of_window, ledger_warning
from ...run.counters import Course
from ...run.window import Window
from ...scene.drive import Ports
from ...scene.live import PORT_FIELDS
from ..container.records import RecordingError, files_of
from ..ros2.axes_fields import axes_state_fields, axes_waveform_fields, largest_of_kind
from ..ros2.definitions import OF_AXES, OF_DAMAGE
from ..ros2.fields import joint_fields_like, state_fields, waveform_fields
from ..ros2.sensor_messages import kinds_of
from ..ros2.sensor_topics import OF_TEMPERATURES, SENSORS, sensor_topics
from ..ros2.topics import AXES_STATE, AXES_WAVEFORM, GIVEN, JOINTS, STATE, WAVEFORM
from ..ros2.typestore import is_recorded
from .expected_sensors import Expected
from .intervals import Interval
from .origin import Measured, makers_here
from .resimulation import Resimulation
from .schedule import Change, RecordedRun, messages_of, read_runs, stamp_of

_COMPARED = (STATE, WAVEFORM, JOINTS, *OF_AXES)
ROUNDING = 1000  # [ns] of the stamp of the first sample of an interval
TEXTS = ("names", "units", "unit", "parts", "worst", "replaced")  # which others determine
LATE = 1_000_000_000  # [ns] by which filters and levels delay what sensors read, at most
STOPPED = 5_000_000_000  # [ns] by which topics may end apart if a recorder is stopped
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


def verify(
    path: Path, namespace: str, progress: Callable[[float], None] = lambda time: None
) -> Comparison:
    """Simulate the runs of a gearbox again and compare all published values.

    Args:
        path: path of the recording.
        namespace: namespace of the gearbox.
        progress: called with the simulated time [s] up to which everything is compared.

    Returns:
        The result.

    Raises:
        RecordingError: nothing can be simulated again, or the recording was measured.
    """
    result = Comparison()
    size = _bytes_in(path)
    runs = read_runs(path, namespace, result.remarks)
    _refuse_measured(path, runs)
    here = makers_here()
    result.same_makers = all(run.origin.makers == here for run in runs)
    result.not_recorded = sum(run.missing for run in runs)
    resimulation = Resimulation(runs, result.remarks)
    strays, balance, loosest = list[tuple[str, int]](), Balance(), 0.0
    newest = 0  # stamp of a state [ns]
    course = Course()
    of_sensors = {topic for run in runs for topic in sensor_topics(kinds_of(run.origin.scene))}
    for topic, message in messages_of(path, namespace, (*_COMPARED, *OF_DAMAGE, *of_sensors), []):
        newest = max(newest, stamp_of(message)) if topic == STATE else newest
        if topic in of_sensors or topic in OF_DAMAGE:
            again = resimulation.of_sensor if topic in of_sensors else resimulation.of_damage
            if expected := again(topic, message):
                _compare_sensor(result, topic, message, expected)
            else:
                strays.append((topic, stamp_of(message)))
        elif simulated := resimulation.interval_of(topic, message):
            _compare(result, topic, message, *simulated)
            if topic == STATE:
                balance = balance.joined(balance_of_window(simulated[1]))
                course = course.joined(simulated[1].course)
                loosest = max(loosest, simulated[0].tolerance)
            progress(simulated[1].end)
        else:
            strays.append((topic, stamp_of(message)))
    if result.first_difference and any(map(_lacks_commands, runs)):
        result.remarks.append(
            f"torque or motion is given at a port, but {GIVEN} has no message of it: commands that "
            "are not recorded explain a difference"
        )
    result.ledger = ledger_warning(balance, loosest)
    result.accuracy = list(course_warnings(course))
    # A recorder may have been stopped between the messages of an interval, or write on meanwhile.
    until: float = newest + STOPPED
    if _bytes_in(path) > size:
        newest, until = runs[-1].intervals[-1].stamp, math.inf
    left_out = Counter(
        topic for topic, stamp in strays if not _begin(topic, newest) < stamp < until
    )
    result.left_out = left_out.total()
    result.remarks += [
        f"{count} messages of {topic} belong to no interval that is simulated again"
        for topic, count in left_out.items()
    ]
    return result


def _begin(topic: str, newest: int) -> int:
    """Stamp above which a message belongs to an interval after that of the newest state."""
    if topic.startswith(f"{SENSORS}/") or topic in OF_TEMPERATURES:
        return newest - LATE
    return newest - ROUNDING if topic in (WAVEFORM, AXES_WAVEFORM) else newest


def _lacks_commands(run: RecordedRun) -> bool:
    """Whether torque or motion is given at a port, and no command is recorded."""
    ports = [run.origin.scene.drive.ports, *map(_ports, run.changes)]
    return not run.given and any(each.given for each in ports)


def _ports(change: Change) -> Ports:
    return Ports(**{side: change.values.get(name, "machine") for name, side in PORT_FIELDS.items()})


def _bytes_in(path: Path) -> int:
    return sum(file.stat().st_size for file in files_of(path))


def _refuse_measured(path: Path, runs: list[RecordedRun]) -> None:
    """Raise `RecordingError` for measured runs, which a simulation cannot reproduce."""
    for run in runs:
        makers = run.origin.makers
        if isinstance(makers, Measured):
            raise RecordingError(
                f"{path}: was measured (imported from {makers.measured}), not simulated, so it "
                "cannot be verified; `fit` compares it with the model"
            )


def _compare(
    result: Comparison, topic: str, message: Any, interval: Interval, window: Window
) -> None:
    """Compare a message, and add the result."""
    _compare_fields(result, topic, message, _expected(topic, message, window), interval, window)


def _compare_sensor(result: Comparison, topic: str, message: Any, expected: Expected) -> None:
    interval, window, simulated = expected
    numbers = {name: value for name, value in simulated.fields.items() if name not in TEXTS}
    _compare_fields(result, topic, message, numbers, interval, window)


def _compare_fields(
    result: Comparison,
    topic: str,
    message: Any,
    expected: Mapping[str, Any],
    interval: Interval,
    window: Window,
) -> None:
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


def _expected(topic: str, message: Any, window: Window) -> Mapping[str, Any]:
    if topic == STATE:
        names = [field.name for field in fields(message)]  # of the version that recorded
        fields_of_window = state_fields(window, names)
        return {name: fields_of_window[name] for name in names if name in fields_of_window}
    if topic == WAVEFORM:
        return waveform_fields(window)
    if topic in OF_AXES:
        return _axes(topic, message, window)
    return joint_fields_like(window, message)


def _axes(topic: str, message: Any, window: Window) -> Mapping[str, Any]:
    """Fields of an AxesState message; empty if the axes are fixed."""
    if window.axes is None:
        raise RecordingError(f"{topic}: recorded of a scene whose axes are held")
    if topic == AXES_WAVEFORM:
        return axes_waveform_fields(window)
    found = axes_state_fields(window)
    return {name: value for name, value in found.items() if is_recorded(message, name)}


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
