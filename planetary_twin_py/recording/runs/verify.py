"""Simulates again what is recorded, and compares every value."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, fields
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from ...ledger_check import Balance, balance_of_window, ledger_warning
from ...window import Window
from ..container.records import RecordingError
from ..ros2.fields import joint_fields_like, state_fields, waveform_fields
from ..ros2.topics import JOINTS, STATE, WAVEFORM
from .origin import Measured, makers_here
from .resimulation import Again
from .schedule import Interval, Run, messages_of, read_runs

BOUND = 10.0  # times the tolerance, by which other machines may differ; each keeps within 3


class Difference(NamedTuple):
    """A value that is not as it was simulated again."""

    time: float  # simulated [s], of the end of its interval
    topic: str
    field: str
    place: int  # in an array
    recorded: float
    simulated: float


@dataclass
class Comparison:
    """What a comparison has found; `remarks` says in lines what could not be compared."""

    same_makers: bool = True
    """Whether the recording comes from the same kernels on the same kind of machine."""
    messages: dict[str, int] = field(default_factory=dict)
    """How many were compared, by topic."""
    left_out: int = 0
    """How many were read and could not be compared."""
    not_recorded: int = 0
    """Intervals on the way that the recording has no state of."""
    values: int = 0
    first_difference: Difference | None = None
    largest: float = 0.0
    """Largest difference of a value, relative to the largest of its array times the tolerance."""
    remarks: list[str] = field(default_factory=list)
    ledger: str | None = None
    """Where the energy ledger of what was compared does not close: what that means."""

    @property
    def identical(self) -> bool:
        """Whether all that is in the file was compared, and not a bit differs."""
        return self.first_difference is None and not self.remarks

    @property
    def within_bound(self) -> bool:
        """Whether the differences are no larger than two machines may show."""
        return self.largest <= BOUND and not self.remarks


def verify(
    path: Path, namespace: str, progress: Callable[[float], None] = lambda time: None
) -> Comparison:
    """Simulate again the runs of the gearbox in `namespace` and compare all that was published.

    `progress` hears the simulated time [s] up to which all is compared.
    Raises:
        RecordingError: nothing in the recording can be simulated again, or it was measured.
    """
    verdict = Comparison()
    runs = read_runs(path, namespace, verdict.remarks)
    _refuse_measured(path, runs)
    here = makers_here()
    verdict.same_makers = all(run.origin.makers == here for run in runs)
    verdict.not_recorded = sum(_missing(run) for run in runs)
    again, strays, balance, loosest = Again(runs, verdict.remarks), Counter[str](), Balance(), 0.0
    for topic, message in messages_of(path, namespace, (STATE, WAVEFORM, JOINTS), []):
        if found := again.interval_of(topic, message):
            _compare(verdict, topic, message, *found)
            if topic == STATE:
                balance = balance.joined(balance_of_window(found[1]))
                loosest = max(loosest, found[0].tolerance)
            progress(found[1].end)
        else:
            strays[topic] += 1
    verdict.ledger = ledger_warning(balance, loosest)
    verdict.left_out = strays.total()
    verdict.remarks += [
        f"{count} messages of {topic} belong to no interval that is simulated again"
        for topic, count in strays.items()
    ]
    return verdict


def _missing(run: Run) -> int:
    """Count the intervals between a run's first and last that are not recorded."""
    first, last = run.intervals[0], run.intervals[-1]
    return last.number - first.number + 1 - len(run.intervals)


def _refuse_measured(path: Path, runs: list[Run]) -> None:
    """What no model has computed is not the same again, to the last bit or within a bound."""
    for run in runs:
        makers = run.origin.makers
        if isinstance(makers, Measured):
            raise RecordingError(
                f"{path}: was measured (it comes from {makers.measured}) and not simulated, so "
                "there is nothing to be the same; `fit` compares it with the model"
            )


def _compare(
    verdict: Comparison, topic: str, message: Any, interval: Interval, window: Window
) -> None:
    """Count a message, and what of it differs."""
    verdict.messages[topic] = verdict.messages.get(topic, 0) + 1
    for name, simulated in _expected(topic, message, window).items():
        recorded = np.atleast_1d(getattr(message, name))
        simulated = np.atleast_1d(simulated).astype(recorded.dtype)
        verdict.values += recorded.size
        if recorded.tobytes() == simulated.tobytes():
            continue
        verdict.largest = max(verdict.largest, _distance(recorded, simulated) / interval.tolerance)
        if verdict.first_difference is None:
            verdict.first_difference = _first(topic, name, window.end, recorded, simulated)


def _expected(topic: str, message: Any, window: Window) -> Mapping[str, Any]:
    if topic == STATE:
        return state_fields(window, [field.name for field in fields(message)])
    if topic == WAVEFORM:
        return waveform_fields(window)
    return joint_fields_like(window, np.asarray(message.position))


def _distance(recorded: np.ndarray, simulated: np.ndarray) -> float:
    """Largest difference, relative to the largest value; infinite where only one is a number."""
    if recorded.shape != simulated.shape:
        return float("inf")
    if not np.array_equal(np.isfinite(recorded), np.isfinite(simulated)):
        return float("inf")
    sound = np.isfinite(simulated)
    size = np.abs(simulated[sound]).max(initial=0.0)
    apart = np.abs(recorded[sound] - simulated[sound]).max(initial=0.0)
    return float(apart / size) if size > 0.0 else float("inf") if apart > 0.0 else 0.0


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
