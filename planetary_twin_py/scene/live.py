"""Fields of a scene that may change while it runs: its operating point, and its ports."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from .drive import Ports
from .names import no_such_field
from .operating_point import TUNABLES, OperatingPoint
from .quantity import SceneError

PORT_FIELDS = {f"drive.{side}.port": side for side in Ports._fields}
"""Sides of the ports, by the names of their fields."""
LIVE = (*TUNABLES, *PORT_FIELDS)
"""Names of all fields that may change, as `Scene.replace` accepts them."""


def live_values(point: OperatingPoint, ports: Ports) -> dict[str, Any]:
    """Values of all fields that may change.

    Args:
        point: operating point.
        ports: what acts on the shafts of input and output.

    Returns:
        Values in SI by the names of `LIVE`.
    """
    return {**dict(point), **{name: getattr(ports, side) for name, side in PORT_FIELDS.items()}}


def split_live(changes: Mapping[str, Any]) -> tuple[dict[str, float], dict[str, Any]]:
    """Divide changes into those of the operating point and those of the ports.

    Args:
        changes: values by name.

    Returns:
        Values of the operating point by name, and causalities by the fields of `Ports`.

    Raises:
        SceneError: a name is not one of `LIVE`.
    """
    for name in changes:
        if name not in LIVE:
            raise SceneError(no_such_field(name, LIVE))
    point = {name: value for name, value in changes.items() if name in TUNABLES}
    return point, {PORT_FIELDS[name]: v for name, v in changes.items() if name in PORT_FIELDS}
