"""Reports in /diagnostics, written and read: each is a row with a level, a message and values."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import NamedTuple

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue

from planetary_twin_py.recording.ros2.topics import REAL_TIME, is_status, status_name


class Row(NamedTuple):
    """One report, named such as `simulation: accuracy`."""

    report: str
    level: bytes
    message: str
    values: Mapping[str, object] = {}


def checked(report: str, fault: str | None, sound: str, values: Mapping[str, object]) -> Row:
    """Return a warning of `fault` if there is one, else the message `sound`."""
    level = DiagnosticStatus.WARN if fault else DiagnosticStatus.OK
    return Row(report, level, fault or sound, values)


def diagnostics(rows: Iterable[Row], namespace: str, hardware: str = "") -> DiagnosticArray:
    """
    Return `rows` as a message of a node in `namespace`, not stamped yet.

    `hardware` is the `hardware_id`, by default the namespace.
    """
    return DiagnosticArray(
        status=[
            DiagnosticStatus(
                level=level,
                name=status_name(report, namespace),
                message=message,
                hardware_id=hardware or namespace,
                values=[KeyValue(key=key, value=str(value)) for key, value in values.items()],
            )
            for report, level, message, values in rows
        ]
    )


def real_time_figures(message: DiagnosticArray, namespace: str) -> dict[str, str]:
    """Return the values of the real-time report of the twin in `namespace`; empty without one."""
    return {
        item.key: item.value
        for status in message.status
        if is_status(status.name, REAL_TIME) and status.hardware_id == namespace
        for item in status.values
    }
