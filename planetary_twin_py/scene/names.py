"""Suggestions for mistyped names."""

from __future__ import annotations

from collections.abc import Iterable
from difflib import get_close_matches

NEAR = 0.7  # similarity by difflib below which a name is not suggested
_MOST = 3
_FEW = 20  # names of a section that a message lists


def no_such_field(name: str, known: Iterable[str], elsewhere: Iterable[str] = ()) -> str:
    """Error message for `name`, with the names that may be meant.

    These are similar `known` names, else similar names `elsewhere`, else all `known` names, if they
    are few.
    """
    names = list(known)
    meant = did_you_mean(name, names) or did_you_mean(name, elsewhere)
    if not meant and 0 < len(names) <= _FEW:
        meant = f"; there are {', '.join(sorted(names))}"
    return f"{name}: no such field{meant}"


def did_you_mean(name: str, known: Iterable[str]) -> str:
    """Suggestion of similar `known` names, to append to an error message; empty if none."""
    near = nearest(name, known)
    return f"; did you mean {' or '.join(near)}?" if near else ""


def nearest(name: str, known: Iterable[str]) -> list[str]:
    """The `known` names similar to `name`.

    Names are compared without their sections, which all fields of a section share: viscosity is
    similar to lubrication.viscosity, but mesh.colour is not similar to other fields of mesh. If
    none is similar, those that begin with the whole name are returned: lambda_ratio for lambda.
    """
    places: dict[str, list[str]] = {}
    for path in known:
        places.setdefault(_own(path), []).append(path)
    for own in get_close_matches(_own(name), places, 1, NEAR):
        return get_close_matches(name, places[own], _MOST, 0.0)
    longer = [path for own in places if own.startswith(f"{_own(name)}_") for path in places[own]]
    return get_close_matches(name, longer, _MOST, 0.0)


def _own(path: str) -> str:
    return path.rpartition(".")[2]
