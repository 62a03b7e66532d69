"""Damage of a run: that of its windows, added to what the gearbox had at its start."""

from __future__ import annotations

import math
from copy import deepcopy
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .damage import Damage
from .damage_state import HOUR, DamageState, Replacement
from .sums import Sums

EVERY, EVERY_TEETH = 1.0, 10.0  # [s] of simulated time between two messages
_SLACK = 1e-9  # [s] of times that are sums of intervals


class RunDamage:
    """Adds the damage of windows to a state.

    The same windows after the same start give the same sums to the last bit.

    Args:
        start: damage at the start; it is not changed.
    """

    def __init__(self, start: DamageState) -> None:
        self.state = deepcopy(start)
        """The damage now."""
        self._teeth = np.ones(len(start.parts), dtype=np.int64)
        self._reported = self.state.sums  # at the last message
        self._since = 0.0  # [s] since then

    def add(self, damage: Damage) -> None:
        """Add the damage of the next window."""
        state, self._teeth = self.state, damage.teeth
        state.damage.add(damage.damage[None])
        for part, each in damage.of_teeth.damage.items():
            apart = each - damage.damage[damage.parts.index(part)]
            state.teeth.setdefault(part, Sums.zero(*each.shape)).add(apart[None])
        state.times.counted.add(np.array([damage.duration]))
        passages = zip(state.passages, damage.passages.tolist(), strict=True)
        state.passages = [before + more for before, more in passages]
        state.turning = {**state.turning, **damage.turning}
        self._since += damage.duration

    def replace_part(self, name: str, time: float) -> tuple[Replacement, ...]:
        """Set the damage of a part to 0, see `DamageState.replace_part`."""
        entries = self.state.replace_part(name, time)
        for entry in entries:
            self._reported[self.state.parts.index(entry.part)] = 0.0
        return entries

    def messages(self, start: float, end: float) -> dict[str, dict[str, Any]]:
        """Messages that are due after a window has been added, by topic.

        Args:
            start: start of the window, simulated [s].
            end: its end [s].

        Returns:
            Fields without header and sequence: DamageState once in a simulated second, DamageTeeth
            once in ten.
        """
        due = {}
        if _passes(EVERY, start, end):
            hours = self._since / HOUR
            rate = (self.state.sums - self._reported) / hours
            due["damage_state"] = state_fields(self.state, rate, end)
            self._reported, self._since = self.state.sums, 0.0
        if _passes(EVERY_TEETH, start, end):
            due["damage_teeth"] = teeth_fields(self.state, self._teeth, end)
        return due


def state_fields(
    state: DamageState, rate: NDArray[np.float64], time: float = math.nan
) -> dict[str, Any]:
    """Fields of a message DamageState.

    Args:
        state: the damage.
        rate: present rates [1/h], (parts,).
        time: simulated time [s]; NaN of a measured gearbox.
    """
    log = state.replaced
    return {
        "simulated_time": time,
        "hours": state.hours,
        "unknown_hours": float(state.times.unknown.total) / HOUR,
        "outside_hours": float(state.times.outside.total) / HOUR,
        "parts": list(state.parts),
        "damage": state.sums,
        "rate": rate,
        "mean_rate": state.rates,
        "remaining_hours": state.remaining_hours,
        "passages": np.array(state.passages, dtype=np.int64),
        "worst": state.worst,
        "replaced": [entry.part for entry in log],
        "replaced_at": np.array([entry.time for entry in log], dtype=np.float64),
        "replaced_damage": np.array([entry.damage for entry in log], dtype=np.float64),
    }


def teeth_fields(
    state: DamageState, teeth: NDArray[np.int64], time: float = math.nan
) -> dict[str, Any]:
    """Fields of a message DamageTeeth.

    Args:
        state: the damage.
        teeth: teeth of each part; 1 for bearings, (parts,).
        time: simulated time [s]; NaN of a measured gearbox.
    """
    of_gears = [n for n, count in enumerate(teeth) if count > 1]
    return {
        "simulated_time": time,
        "parts": [state.parts[n] for n in of_gears],
        "teeth": teeth[of_gears].astype(np.uint32),
        "damage": np.concatenate([state.of_teeth(state.parts[n], teeth[n]) for n in of_gears]),
    }


def _passes(period: float, start: float, end: float) -> bool:
    """Whether a multiple of a period is after the start of a window, and not after its end."""
    return math.floor((end + _SLACK) / period) > math.floor((start + _SLACK) / period)
