"""Reads the real-time report of a simulation from /diagnostics."""

from __future__ import annotations

from diagnostic_msgs.msg import DiagnosticArray

from planetary_twin_py.recording.ros2.topics import REAL_TIME, is_status


def real_time_figures(message: DiagnosticArray, namespace: str) -> dict[str, str]:
    """
    Return the values of the real-time report in `message`, by key.

    Empty unless it is the report of the twin in `namespace`.
    """
    return {
        item.key: item.value
        for status in message.status
        if is_status(status.name, REAL_TIME) and status.hardware_id == namespace
        for item in status.values
    }
