"""Groups the changes of an operating point that are steps of one ramp."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any

from ...scene.live import PORT_FIELDS, unit_of_live
from ...text.escaping import LONGEST_NAME, one_line
from .contents import Changed

LONGEST_STEP = 0.11  # [s] of simulated time between two steps; intervals are up to a tenth
_ROUNDING = 1e-6  # [s]


@dataclass
class Ramp:
    """Changes of the same fields of one gearbox; a single change is a ramp of one step."""

    times: list[float]
    """Times of the changes [s]."""
    first: Mapping[str, Any]
    """Values of the changed fields before the ramp, as far as they are known."""
    last: Mapping[str, Any]

    @property
    def duration(self) -> float:
        """Duration of all steps [s]; the last is assumed to last as long as the others."""
        steps = len(self.times)
        return (self.times[-1] - self.times[0]) * steps / max(steps - 1, 1)

    def in_words(self) -> list[str]:
        """Texts of the changed fields with their values, without commas."""
        if not self.last:
            return ["no change"]
        if len(self.times) == 1:
            return [f"{name} = {_value(name, value)}" for name, value in self.last.items()]
        *fields, last = (
            f"{name} from {self.first[name]:.6g} to {_value(name, value)}"
            for name, value in self.last.items()
        )
        return [*fields, f"{last} in {len(self.times)} steps over {self.duration:.6g} s"]

    def add(self, change: Changed) -> bool:
        """Add `change` if it is the next step; return whether it is."""
        same = change.values.keys() == self.last.keys() == self.first.keys()
        if not (same and self._in_time(change.time) and self._continues(change.values)):
            return False
        self.times.append(change.time)
        self.last = change.values
        return True

    def _in_time(self, time: float) -> bool:
        """Whether the time to a change at `time` [s] equals that between the last two changes."""
        gap = time - self.times[-1]
        before = self.times[-1] - self.times[-2] if len(self.times) > 1 else gap
        return 0.0 < gap < LONGEST_STEP and math.isclose(gap, before, abs_tol=_ROUNDING)

    def _continues(self, values: Mapping[str, Any]) -> bool:
        """Whether `values` are numbers that continue in the direction of the previous changes."""
        last = self.last
        return not PORT_FIELDS.keys() & values.keys() and all(
            (values[k] - last[k]) * (last[k] - first) > 0.0 for k, first in self.first.items()
        )


def _value(name: str, value: float | str) -> str:
    """A value with its unit; a text of unknown origin on one line."""
    if isinstance(value, str):
        return one_line(value, LONGEST_NAME)
    return f"{value:.6g} {unit_of_live(name) or ''}".rstrip()


def ramps(changes: Iterable[Changed]) -> list[Ramp]:
    """Group `changes`, in order, into ramps."""
    grouped: list[Ramp] = []
    newest: dict[str, Ramp] = {}
    values: dict[str, dict[str, Any]] = {}
    for change in changes:
        known = values.setdefault(change.namespace, {})
        current = newest.get(change.namespace)
        if current is None or not current.add(change):
            first = {name: known[name] for name in change.values if name in known}
            newest[change.namespace] = Ramp([change.time], first, change.values)
            grouped.append(newest[change.namespace])
        known |= change.values
    return grouped
