"""A column of a study's table as it is drawn: in the engineer's units, with both in its label."""

from __future__ import annotations

from difflib import get_close_matches
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from ..quantities import MESH, OPERATING_POINT, RPM, TRAIN, WAVEFORM, Quantity

if TYPE_CHECKING:
    import pyarrow as pa

SIDES = {"sun_planet": "sun-planet", "planet_ring": "planet-ring"}
LENGTHS = ((1e-3, "µm", 1e6), (1.0, "mm", 1e3))  # below which [m], unit, factor
UNITS = {"rad/s": ("rpm", RPM), "rad": ("°", 180.0 / np.pi)}
LEAST_RATIO = 25.0  # from the least value to the largest, for a logarithmic axis


class Column(NamedTuple):
    """Values as they are drawn, shape (rows,), numbers or words."""

    name: str
    values: np.ndarray
    quantity: Quantity

    @property
    def label(self) -> str:
        """Of an axis."""
        return self.quantity.heading if self.is_number else self.quantity.title

    @property
    def is_number(self) -> bool:
        """Whether there is an axis on which the values lie."""
        return self.values.dtype.kind in "fi"

    @property
    def distinct(self) -> np.ndarray:
        """Values that occur, in their order; words as they come first."""
        if self.is_number:
            return np.unique(self.values)
        return np.array(list(dict.fromkeys(self.values.tolist())))

    @property
    def is_logarithmic(self) -> bool:
        """Whether the values stand closer to equal ratios than to equal distances."""
        if not self.is_number or len(self.distinct) < 3 or self.distinct[0] <= 0.0:
            return False
        if self.distinct[-1] < LEAST_RATIO * self.distinct[0]:
            return False
        steps, ratios = np.diff(self.distinct), np.diff(np.log(self.distinct))
        return bool(ratios.std() / ratios.mean() < steps.std() / steps.mean())

    def told(self, value: Any) -> str:
        """One of the values, in words."""
        if not self.is_number:
            return f"{value}"
        return f"{value:.4g} {self.quantity.unit}".removesuffix(" -")


def columns(table: pa.Table) -> dict[str, Column]:
    """Every column of a study's table."""
    return {field.name: _column(table, field) for field in table.schema}


def find(known: dict[str, Column], name: str, role: str) -> Column:
    """The column of this name.

    Raises:
        ValueError: there is none; names those that are called alike.
    """
    if name in known:
        return known[name]
    near = get_close_matches(name, known, n=4, cutoff=0.5) or list(known)
    raise ValueError(f"{role} = {name!r}: the table has no such column, but {', '.join(near)}")


def _column(table: pa.Table, field: pa.Field) -> Column:
    values = np.array(table[field.name].to_pylist())
    if values.dtype == object and table[field.name].type != "string":
        values = values.astype(float)  # None is NaN
    metadata = field.metadata or {}
    unit = metadata.get(b"unit", b"").decode()
    quantity = _known(field.name) or _by_unit(field.name, unit, values)
    scaled = values * quantity.factor if values.dtype.kind == "f" else values
    return Column(field.name, scaled, quantity)


def _known(name: str) -> Quantity | None:
    """Of a figure or a set-point that has a name of its own."""
    plain = {key: each for key, (each, _) in TRAIN.items() if key not in ("speed", "power")}
    plain |= OPERATING_POINT
    plain["power_loss"] = Quantity("Power loss", "W")  # of bearings and churning, too
    if name in plain:
        return plain[name]
    for side, words in SIDES.items():
        if not name.startswith(f"{side}_"):
            continue
        measure = name.removeprefix(f"{side}_")
        if measure in MESH:
            quantity = MESH[measure]
            title = "Power loss" if measure == "power_loss" else quantity.title
            return quantity._replace(title=f"{title}, {words}")
        number, _, waveform = measure.partition("_")
        if waveform in WAVEFORM:
            quantity = WAVEFORM[waveform]
            return quantity._replace(title=f"{quantity.title} of {words} mesh {number}")
    return None


def _by_unit(name: str, unit: str, values: np.ndarray) -> Quantity:
    """Of any other field of a scene, by its name."""
    words = name.rpartition(".")[2].replace("_", " ")
    title = words[:1].upper() + words[1:]
    if unit == "m" and values.dtype.kind == "f" and len(values):
        largest = np.nanmax(np.abs(values), initial=0.0)
        for limit, shown, factor in LENGTHS:
            if largest < limit:
                return Quantity(title, shown, factor)
    shown, factor = UNITS.get(unit, (unit or "-", 1.0))
    return Quantity(title, shown, factor)
