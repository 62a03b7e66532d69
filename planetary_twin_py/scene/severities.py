"""Severities of faults by dotted names, `faults.0.depth`: values, ranges, and changes."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from .faults import Bearing, Crack, Fault, Pin, Pitch, Spall, Wear
from .operating_point import Tunable
from .quantity import bounds, unit_of

UNITS = {
    field: unit_of(kind.model_fields[field]) or ""
    for kind in (Crack, Spall, Wear, Pitch, Pin, Bearing)
    for field in ("depth", *kind.SEVERITIES, "stiffness_loss")
    if field in kind.model_fields
}
"""SI units of severities by the names of their fields."""


def severities(faults: Sequence[Fault]) -> dict[str, float]:
    """Values of all severities by dotted name, `faults.0.depth`."""
    return {name: getattr(fault, field) for name, fault, field in _named(faults)}


def severity_tunables(faults: Sequence[Fault]) -> dict[str, Tunable]:
    """Descriptions of all severities by dotted name."""
    found = {}
    for name, fault, field in _named(faults):
        info = type(fault).model_fields[field]
        described = f"{fault.kind}: {info.description}"
        found[name] = Tunable(name, unit_of(info) or "", described, *bounds(info))
    return found


def with_severities(faults: Sequence[Fault], values: Mapping[str, float]) -> tuple[Fault, ...]:
    """Faults with other severities, which are not checked.

    Args:
        faults: of a scene.
        values: severities by dotted name.
    """
    changed: dict[int, dict[str, float]] = {}
    for name, value in values.items():
        _, place, field = name.split(".")
        changed.setdefault(int(place), {})[field] = value
    return tuple(
        fault.model_copy(update=changed[n]) if n in changed else fault
        for n, fault in enumerate(faults)
    )


def _named(faults: Sequence[Fault]) -> Iterator[tuple[str, Any, str]]:
    for n, fault in enumerate(faults):
        for field in fault.severities:
            yield f"faults.{n}.{field}", fault, field
