"""Operating point and ports in messages of type OperatingPoint."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ...scene.live import LIVE
from .typestore import is_recorded

FIELDS = {name: name.removeprefix("drive.").replace(".", "_") for name in LIVE}
"""Fields of the message, by the arguments of `Twin.set`."""


def point_fields(values: Mapping[str, Any], last: Mapping[str, Any] | None) -> dict[str, Any]:
    """Fields of the message for all values.

    Args:
        values: all that may change, by the arguments of `Twin.set`.
        last: those of the previous message; None for the first one.

    Returns:
        The fields, without header, sequence and time.
    """
    changed = (FIELDS[name] for name in LIVE if last is None or values[name] != last[name])
    return {"changed": ",".join(changed), **{FIELDS[name]: values[name] for name in LIVE}}


def values_of_point(message: Any) -> dict[str, Any]:
    """Values of a recorded message by the arguments of `Twin.set`.

    What could not be changed in the version that recorded has no field, and no value here.
    """
    recorded = {name: field for name, field in FIELDS.items() if is_recorded(message, field)}
    return {name: getattr(message, field) for name, field in recorded.items()}
