"""Steps of the torque balance as events: their size, their start and their causes."""

from __future__ import annotations

import math
from collections import deque
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from ...text.intervals import plus_minus
from ...units.engineering import percent
from ..estimate import CONFIDENT, Event, estimated
from .balances import CAUSES, FRICTION, PARAMETERS, B, Balances, D, F, G, Measured, joined
from .filter import LEAST, BalanceFilter
from .loss_step import LONGEST, StepCause, size_of
from .monitor import Monitor

Array = NDArray[np.float64]

RECENT = 1_200  # bins from which the size of a step is estimated at most
MARGIN = 5.0  # [s] by which a step may start before the sum of the CUSUM leaves zero
MANY = 100.0  # ratio above which a step is not compared with a loss or a torque
FREQUENT, UNSTEADY = 3, 60.0  # steps in so many seconds that no single cause explains


class StepEvents:
    """Keeps the last bins of one gearbox, and reports its steps."""

    def __init__(self, monitor: Monitor) -> None:
        self.events: list[Event] = []
        """Steps that have been found."""
        self._monitor = monitor
        self._recent: deque[tuple[Measured, BalanceFilter]] = deque(maxlen=RECENT)
        """Last bins, and the filter for intervals as it was before each of them."""
        self._last_step: tuple[BalanceFilter, StepCause, int] | None = None
        self._times: deque[float] = deque()  # [s], the latest last

    def note(self, read: Measured, before: BalanceFilter) -> None:
        """Keep a bin, with the filter for intervals as it was before it."""
        self._recent.append((read, before))

    def alarm(self, since: float, found: float, operating: tuple[float, float]) -> None:
        """Report a step that was found at a time [s], and adapt the filters to it.

        The sum of the CUSUM left zero at `since`. `operating` are speed [rad/s] and oil [K].
        """
        reads, filters = zip(*self._recent, strict=True)
        times = np.array([read.time for read in reads])
        offset = min(int(np.searchsorted(times, since - MARGIN)), len(times) - 1)
        reference_filter, read, times = filters[offset], joined(reads[offset:]), times[offset:]
        balances, covariance = reference_filter.balances(read), reference_filter.p[0]
        step_size = size_of(balances, covariance)
        direction = math.copysign(1.0, operating[0])
        since_step = balances.since(step_size.likely)
        possible = _possible_causes(reference_filter, direction * step_size.size, since_step)
        cause = StepCause(found, covariance, possible)
        cause.add(since_step)
        size = estimated("loss_torque_step", direction * step_size.size, step_size.sd, "N m")
        torque = float(np.mean(read.input_torque[step_size.likely :]))
        loss = float(self._monitor.losses(torque, *operating).teeth)
        evidence = f"{plus_minus(size.value, CONFIDENT * size.sd, '+')} N m"
        for reference, name in ((loss, "the scene's tooth friction"), (abs(torque), "the torque")):
            if abs(size.value) < MANY * reference:
                evidence += f", {percent(size.value / reference, 3)} of {name}"
        first = float(times[step_size.first]) - 0.5 * self._monitor.period
        from_start = offset + step_size.first == 0 and len(self._recent) < RECENT
        description = "readings do not fit the scene" if from_start else "loss torque stepped"
        self._report(
            reference_filter,
            cause,
            Event(description, first, found, size, cause.causes, evidence),
        )
        slope = np.sqrt(np.mean(since_step.slope**2, axis=0))
        self._monitor.reopen(np.array([True]), self._explaining(step_size.size, slope))

    def _explaining(self, size: float, slope: Array) -> Array:
        """Standard deviations with which friction, zero, drag or gain alone explain a step, (7,).

        Each is at least as uncertain as it was before any reading.
        """
        prior, opened = self._monitor.intervals.sd, np.zeros(len(PARAMETERS))
        needed = abs(size) / np.maximum(np.abs(slope), LEAST * prior)
        causes = [F, B, D, G]
        opened[causes] = np.maximum(needed, prior)[causes]
        return opened

    def _report(self, reference_filter: BalanceFilter, cause: StepCause, event: Event) -> None:
        """Add an event, unless steps follow each other: then no single cause explains them."""
        while self._times and event.found - self._times[0] > UNSTEADY:
            self._times.popleft()
        self._times.append(event.found)
        if len(self._times) > FREQUENT:
            return
        self._last_step = reference_filter, cause, len(self.events)
        if len(self._times) == FREQUENT:
            self._last_step = None
            description = f"the torque balance has stepped {FREQUENT} times in {UNSTEADY:g} s"
            evidence = (
                f"last by {event.evidence}; steps are not reported while they are so frequent"
            )
            event = replace(event, what=description, causes=(), evidence=evidence)
        self.events.append(event)

    def compare_causes(self, read: Measured) -> None:
        """Update the causes of the last step."""
        if self._last_step is None:
            return
        reference_filter, cause, event_index = self._last_step
        if not cause.begin < read.time <= cause.begin + LONGEST:
            return
        cause.add(reference_filter.balances(read))
        if (causes := cause.causes) != self.events[event_index].causes:
            self.events[event_index] = replace(self.events[event_index], causes=causes)


def _possible_causes(before: BalanceFilter, size: float, balances: Balances) -> tuple[str, ...]:
    """Causes of a step [N m]; tooth friction cannot decrease by more than all of it."""
    scene_friction = float(np.mean(np.abs(balances.slope[:, F])))
    least_level = float(before.x[0, F]) - CONFIDENT * before.uncertainty(F)
    if size < -max(least_level, 1.0) * scene_friction:
        return tuple(cause for cause in CAUSES if cause != FRICTION)
    return CAUSES
