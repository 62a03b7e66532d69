"""States of health: the healthy one, and those with the faults of a specification."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from ..scene import Scene, SceneError
from ..scene.severities import UNITS
from ..studies.axes import Axis, Normal, Span
from .draws import first_value, is_distribution, read_draw, value_at

HEALTHY = "healthy"
LEVELS = 3  # of the severity, equally frequent
_LABEL = re.compile(r"[a-z0-9][a-z0-9_+.-]{0,63}")
_COUNTED = ("tooth", "planet", "seed")  # whole numbers that are places, not severities


@dataclass(frozen=True)
class State:
    """A state of health, with what is drawn for each specimen."""

    label: str
    faults: tuple[dict[str, Any], ...]
    """Faults with the first values of what is drawn."""
    draws: tuple[tuple[int, str, Axis | Span | Normal], ...]
    """Number of the fault, its field, and the distribution."""

    @property
    def severity(self) -> str | None:
        """Name of the field that says how severe the state is.

        It is the first severity that is drawn or, if there is none, the first number.
        """
        numbers = [
            (field not in UNITS, place, f"faults.{number}.{field}")
            for place, (number, field, draw) in enumerate(self.draws)
            if field not in _COUNTED and isinstance(draw.ends[1], int | float)
        ]
        return min(numbers)[2] if numbers else None

    def drawn(self, shares: dict[str, float]) -> list[dict[str, Any]]:
        """Fields of each fault of a specimen, in SI where they are drawn.

        Args:
            shares: of the distributions, by "faults.0.depth".
        """
        faults = [dict(fault) for fault in self.faults]
        for number, field, draw in self.draws:
            faults[number][field] = value_at(draw, shares[f"faults.{number}.{field}"])
        return faults


def read_states(scene: Scene, given: tuple[Any, ...]) -> tuple[State, ...]:
    """The states of a specification.

    Args:
        scene: scene of all specimens.
        given: faults, see `DatasetSpec.faults`.

    Returns:
        The healthy state, and the others in order.

    Raises:
        SceneError: an entry is not a fault, or a value is out of range.
    """
    return State(HEALTHY, (), ()), *(
        _state(scene, number, entry) for number, entry in enumerate(given)
    )


def _state(scene: Scene, number: int, entry: Any) -> State:
    place = f"faults.{number}"
    entries = entry if isinstance(entry, list) else [entry]
    if not entries or not all(isinstance(each, dict) for each in entries):
        raise SceneError(f"{place}: must be a fault, {{kind: ..., ...}}, or a list of faults")
    label = "+".join(_label(each, place) for each in entries)
    plain = [{name: value for name, value in each.items() if name != "label"} for each in entries]
    firsts = tuple({name: first_value(value) for name, value in each.items()} for each in plain)
    try:
        faulty = scene.replace(faults=list(firsts))
        return State(label, firsts, tuple(_draws(faulty, plain)))
    except ValueError as error:
        found = re.sub(r"^faults\.(\d+)", lambda m: _name(place, entry, m[1]), str(error))
        raise SceneError(found) from None


def _name(place: str, entry: Any, number: str) -> str:
    """Name in the specification of a fault of the scene."""
    return f"{place}.{number}" if isinstance(entry, list) else place


def _draws(
    scene: Scene, entries: list[dict[str, Any]]
) -> Iterator[tuple[int, str, Axis | Span | Normal]]:
    for number, entry in enumerate(entries):
        for field, value in entry.items():
            if is_distribution(value):
                yield number, field, read_draw(scene, f"faults.{number}.{field}", value)


def _label(entry: dict[str, Any], place: str) -> str:
    names = ("gear", "bearing", "element", "kind")
    default = "_".join(str(entry[name]) for name in names if name in entry)
    label = str(entry.get("label", default))
    if not _LABEL.fullmatch(label) or label == HEALTHY:
        raise SceneError(
            f"{place}.label = {label!r}: must be lower-case letters, digits, _, + and -, "
            f"and not {HEALTHY!r}"
        )
    return label
