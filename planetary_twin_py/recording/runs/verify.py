"""Simulates a recording again and compares every value."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Mapping
from dataclasses import fields
from pathlib import Path
from typing import Any

from ...checks.accuracy import course_warnings
from ...checks.ledger import Balance, balance_of_window, ledger_warning
from ...run.counters import Course
from ...run.window import Window
from ...scene.drive import Ports
from ...scene.live import PORT_FIELDS
from ..container.records import RecordingError, files_of
from ..ros2.axes_fields import axes_state_fields, axes_waveform_fields
from ..ros2.definitions import OF_AXES, OF_DAMAGE
from ..ros2.fields import joint_fields_like, state_fields, waveform_fields
from ..ros2.sensor_messages import kinds_of
from ..ros2.sensor_topics import OF_TEMPERATURES, SENSORS, sensor_topics
from ..ros2.topics import AXES_WAVEFORM, GIVEN, JOINTS, STATE, WAVEFORM
from ..ros2.typestore import is_recorded
from .comparison import Comparison, compare_fields
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


def verify(
    path: Path, namespace: str, progress: Callable[[float], None] = lambda time: None
) -> Comparison:
    """Simulate the runs of a gearbox again and compare all published values.

    Args:
        path: path of the recording.
        namespace: namespace of the gearbox.
        progress: called with the simulated time [s] up to which everything is compared.

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
    compare_fields(result, topic, message, _expected(topic, message, window), interval, window)


def _compare_sensor(result: Comparison, topic: str, message: Any, expected: Expected) -> None:
    interval, window, simulated = expected
    fields = simulated.fields.items()
    numbers = {name: v for name, v in fields if name not in TEXTS and is_recorded(message, name)}
    compare_fields(result, topic, message, numbers, interval, window)


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
