"""Operating point and ports in messages of type OperatingPoint."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

from ...scene.live import FAULTS, LIVE
from .typestore import is_recorded

FIELDS = {name: name.removeprefix("drive.").replace(".", "_") for name in LIVE}
"""Fields of the message, by the arguments of `Twin.set`."""
SEVERITIES = "severities"


OIL = "oil_temperature"


def point_fields(
    values: Mapping[str, Any],
    last: Mapping[str, Any] | None,
    worsened: Iterable[str],
    oil: float | None = None,
) -> dict[str, Any]:
    """Fields of the message for all values.

    Args:
        values: all that may change, by the arguments of `Twin.set`.
        last: those of the previous message; None for the first one.
        worsened: names of the severities that are set at this instant; others may have grown.
        oil: temperature of the oil at this instant [K] if it is a state; None: that of `values`.

    Returns:
        The fields, without header, sequence and time.
    """
    changed = [FIELDS[name] for name in LIVE if last is None or values[name] != last[name]]
    of_faults = (f"{name}={v!r}" for name, v in values.items() if name.startswith(FAULTS))
    return {
        "changed": ",".join([*changed, *worsened]),
        "severities": ",".join(of_faults),
        **{FIELDS[name]: values[name] for name in LIVE},
        **({} if oil is None else {OIL: oil}),
    }


def values_of_point(message: Any) -> dict[str, Any]:
    """Values of a recorded message by the arguments of `Twin.set`.

    What could not be changed in the version that recorded has no field, and no value here. Only
    severities that were set are included: others follow from earlier ones and their growth.
    """
    recorded = {name: field for name, field in FIELDS.items() if is_recorded(message, field)}
    values = {name: getattr(message, field) for name, field in recorded.items()}
    changed = message.changed.split(",")
    if not is_recorded(message, SEVERITIES):
        return values
    severities = severities_of_point(message.severities)
    return values | {name: value for name, value in severities.items() if name in changed}


def severities_of_point(text: str) -> dict[str, float]:
    """Severities in force at a message, by dotted name.

    Args:
        text: the field `severities`; empty in messages of versions without them.
    """
    named = (each.partition("=") for each in filter(None, text.split(",")))
    return {name: float(value) for name, _, value in named}
