"""Names that a mistyped one may be meant for."""

from __future__ import annotations

from collections.abc import Iterable
from difflib import get_close_matches

NEAR = 0.7  # likeness by difflib, below which names share little more than some letters
_MOST = 3


def no_such_field(name: str, known: Iterable[str]) -> str:
    """The refusal of `name`, which is none of the `known`."""
    return f"{name}: no such field{did_you_mean(name, known)}"


def did_you_mean(name: str, known: Iterable[str]) -> str:
    """The `known` names near to `name`, as the end of a refusal; empty where none is near."""
    near = nearest(name, known)
    return f"; did you mean {' or '.join(near)}?" if near else ""


def nearest(name: str, known: Iterable[str]) -> list[str]:
    """The `known` names near to `name`.

    Names are compared without the sections they are in, which all fields of a section share:
    viscosity is near to lubrication.viscosity, mesh.colour to no other field of a mesh.
    """
    places: dict[str, list[str]] = {}
    for path in known:
        places.setdefault(_own(path), []).append(path)
    for own in get_close_matches(_own(name), places, 1, NEAR):
        return get_close_matches(name, places[own], _MOST, 0.0)
    return []


def _own(path: str) -> str:
    return path.rpartition(".")[2]
