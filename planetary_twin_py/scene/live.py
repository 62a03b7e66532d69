"""Fields of a scene that may change while it runs: operating point, ports and severities."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any, NamedTuple

from .drive import Ports
from .names import no_such_field
from .operating_point import TUNABLES, OperatingPoint
from .quantity import SceneError
from .severities import UNITS

PORT_FIELDS = {f"drive.{side}.port": side for side in Ports._fields}
"""Sides of the ports, by the names of their fields."""
LIVE = (*TUNABLES, *PORT_FIELDS)
"""Names of the fields that may change in every scene, as `Scene.replace` accepts them."""
FAULTS = "faults."
"""Begin of the names of severities, which depend on the faults of the scene."""


def live_values(
    point: OperatingPoint, ports: Ports, severities: Mapping[str, float]
) -> dict[str, Any]:
    """Values of all fields that may change.

    Args:
        point: operating point.
        ports: what acts on the shafts of input and output.
        severities: of the faults, by dotted name.

    Returns:
        Values in SI by name.
    """
    of_ports = {name: getattr(ports, side) for name, side in PORT_FIELDS.items()}
    return {**dict(point), **of_ports, **severities}


class LiveChange(NamedTuple):
    """Changes by what they belong to."""

    point: dict[str, float]
    """Values of the operating point by name."""
    ports: dict[str, Any]
    """Causalities by the fields of `Ports`."""
    severities: dict[str, float]
    """Severities by dotted name."""


def split_live(changes: Mapping[str, Any], severities: Iterable[str]) -> LiveChange:
    """Divide changes into those of operating point, ports and severities.

    Raises:
        SceneError: a name is not one of a field that may change.
    """
    known = (*LIVE, *severities)
    for name in changes:
        if name not in known:
            raise SceneError(no_such_field(name, known))
    return LiveChange(
        {name: value for name, value in changes.items() if name in TUNABLES},
        {PORT_FIELDS[name]: v for name, v in changes.items() if name in PORT_FIELDS},
        {name: value for name, value in changes.items() if name.startswith(FAULTS)},
    )


def unit_of_live(name: str) -> str | None:
    """SI unit of a number that may change, "" for one without a unit; None for another field."""
    if name in TUNABLES:
        return TUNABLES[name].unit
    return UNITS.get(name.rpartition(".")[2]) if name.startswith(FAULTS) else None
