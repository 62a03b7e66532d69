"""Columns of a study's table in customary units, with their labels."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from ..scene.names import did_you_mean
from ..units.catalogue import (
    AXES_RESULTS,
    OPERATING_POINT,
    SIDES,
    STUDY_RESULTS,
    WAVEFORM,
    Quantity,
    side_title,
)

if TYPE_CHECKING:
    import pyarrow as pa

LENGTHS = ((1e-3, "µm", 1e6), (1.0, "mm", 1e3))  # upper limit [m], unit, factor
ANGLE = ("°", 180.0 / np.pi)
LEAST_RATIO = 25.0  # largest/smallest value for a logarithmic axis


class Column(NamedTuple):
    """Values in customary units, shape (rows,), numbers or text."""

    name: str
    values: np.ndarray
    quantity: Quantity

    @property
    def label(self) -> str:
        """Label of an axis."""
        return self.quantity.heading if self.is_number else self.quantity.title

    @property
    def is_number(self) -> bool:
        """Whether the values are numbers."""
        return self.values.dtype.kind in "fi"

    @property
    def distinct(self) -> np.ndarray:
        """Distinct values: numbers sorted, text in order of occurrence."""
        if self.is_number:
            return np.unique(self.values)
        return np.array(list(dict.fromkeys(self.values.tolist())))

    @property
    def is_logarithmic(self) -> bool:
        """Whether the values are spaced logarithmically rather than linearly."""
        if not self.is_number or len(self.distinct) < 3 or self.distinct[0] <= 0.0:
            return False
        if self.distinct[-1] < LEAST_RATIO * self.distinct[0]:
            return False
        steps, ratios = np.diff(self.distinct), np.diff(np.log(self.distinct))
        return bool(ratios.std() / ratios.mean() < steps.std() / steps.mean())

    def text(self, value: Any) -> str:
        """One of the values with its unit."""
        if not self.is_number:
            return f"{value}"
        return f"{value:.4g} {self.quantity.unit}".removesuffix(" -")


def columns(table: pa.Table) -> dict[str, Column]:
    """All columns of a study's table by name."""
    return {field.name: _column(table, field) for field in table.schema}


def find(known: dict[str, Column], name: str, role: str) -> Column:
    """Find a column.

    Args:
        known: columns by name.
        name: name of the column.
        role: name of the argument, for the error message.

    Raises:
        ValueError: there is no such column; the message has all names, and similar ones.
    """
    if name in known:
        return known[name]
    raise ValueError(
        f"{role} = {name!r}: no such column; the table has {', '.join(known)}"
        f"{did_you_mean(name, known)}"
    )


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
    """Quantity of a result or a set-point; None for other columns."""
    for known in (STUDY_RESULTS, AXES_RESULTS, OPERATING_POINT):
        if name in known:
            return known[name]
    for side in SIDES:
        number, _, waveform = name.removeprefix(f"{side}_").partition("_")
        if name.startswith(f"{side}_") and waveform in WAVEFORM:
            quantity = WAVEFORM[waveform]
            title = f"{quantity.title} of {side_title(side)} mesh {number}"
            return quantity._replace(title=title)
    return None


def _by_unit(name: str, unit: str, values: np.ndarray) -> Quantity:
    """Quantity of another field of a scene, from its name and unit."""
    words = name.rpartition(".")[2].replace("_", " ")
    title = words[:1].upper() + words[1:]
    if unit == "m" and values.dtype.kind == "f" and len(values):
        largest = np.nanmax(np.abs(values), initial=0.0)
        for limit, shown, factor in LENGTHS:
            if largest < limit:
                return Quantity(title, unit, customary=(shown, factor))
    return Quantity(title, unit, customary=ANGLE if unit == "rad" else None)
