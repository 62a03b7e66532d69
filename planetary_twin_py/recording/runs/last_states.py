"""Last damage and temperatures of a gearbox in a recording."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np

from ..ros2.sensor_message import CELSIUS
from ..ros2.typestore import is_recorded
from .slow_states import FILMS, HOTTEST, TEMPERATURES


class LastDamage(NamedTuple):
    """The last damage of a gearbox."""

    hours: float
    """Time in the sums [h]."""
    parts: dict[str, float]
    """Miner sum by part."""
    replaced: tuple[str, ...]
    """Parts that were replaced, in order."""

    def text(self) -> str:
        """One line: the largest sum, and what was replaced."""
        worst = max(self.parts, key=self.parts.__getitem__, default="")
        largest = f"largest {self.parts[worst]:.4g} of {worst}" if worst else "no parts"
        log = f"; replaced: {', '.join(self.replaced)}" if self.replaced else ""
        return f"{largest}, after {self.hours:.6g} h{log}"


class LastTemperatures(NamedTuple):
    """The last temperatures of a gearbox."""

    parts: dict[str, float]
    """By part and of the ambient air [K]."""
    gain: float | None
    """Feedback gain [-]; None if it is not known."""
    contact: float | None
    """Highest contact temperature of the last period [K]; None if it is not known."""
    film: float | None
    """Smallest specific film of the last period [-]; None if it is not known."""

    def text(self) -> str:
        """One line: all of them in degrees Celsius."""
        parts = [f"{name} {value - CELSIUS:.4g}" for name, value in self.parts.items()]
        rest = []
        if self.gain is not None:
            rest.append(f"feedback gain {self.gain:.3g}")
        if self.contact is not None:
            rest.append(f"contact temperature up to {self.contact - CELSIUS:.4g} degC")
        if self.film is not None:
            rest.append(f"specific film down to {self.film:.3g}")
        return "; ".join([f"{', '.join(parts)} degC", *rest])


def last_damage(message: Any) -> LastDamage:
    """Read a message DamageState."""
    parts = dict(zip(message.parts, map(float, message.damage), strict=True))
    return LastDamage(float(message.hours), parts, tuple(message.replaced))


def last_temperatures(message: Any) -> LastTemperatures:
    """Read a message ThermalState, also of versions without gain and extremes."""
    parts = {name: float(getattr(message, name)) for name in TEMPERATURES}
    gain = message.feedback_gain if is_recorded(message, "feedback_gain") else math.nan
    contact, film = (_known(message, fields) for fields in (HOTTEST, FILMS))
    return LastTemperatures(
        parts, float(gain) if math.isfinite(gain) else None,
        max(contact, default=None), min(film, default=None),
    )  # fmt: skip


def _known(message: Any, fields: tuple[str, ...]) -> list[float]:
    """Known values of some fields."""
    present = [getattr(message, name) for name in fields if is_recorded(message, name)]
    values = np.concatenate([np.empty(0), *present])
    return [float(value) for value in values[np.isfinite(values)]]
