"""The report of the logger in /diagnostics."""

from __future__ import annotations

from collections.abc import Mapping

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue

from planetary_twin_py.recording.ros2.account import TopicAccount
from planetary_twin_py.recording.ros2.topics import status_name

RECORDING = "logger: recording"


class RecordingReport:
    """Reports the losses since the previous report; `hardware` is the logger's namespace."""

    def __init__(self, hardware: str) -> None:
        self._hardware = hardware
        self._missed = 0

    def message(
        self, file: str, size: int, accounts: Mapping[str, TopicAccount]
    ) -> DiagnosticArray:
        """
        Return the report on a recording in progress, not stamped yet.

        `file` is its path, `size` the number of bytes so far, `accounts` the message counts by
        topic.
        """
        missed = sum(account.missed for account in accounts.values())
        new, self._missed = max(missed - self._missed, 0), missed
        lost = sum(account.lost for account in accounts.values())
        figures: dict[str, object] = {"file": file, "bytes": size, "lost": lost}
        for name, account in accounts.items():
            for figure in ("recorded", "lost", "before", "reported"):
                figures[f"{figure}.{name}"] = getattr(account, figure)
        if new:
            return self._array(DiagnosticStatus.WARN, f"lost {new} messages", figures)
        return self._array(DiagnosticStatus.OK, "records all" if accounts else "idle", figures)

    def failure(self, reason: str) -> DiagnosticArray:
        """Return the report on a recording that cannot continue because of `reason`."""
        return self._array(DiagnosticStatus.ERROR, reason, {})

    def _array(self, level: bytes, text: str, figures: Mapping[str, object]) -> DiagnosticArray:
        values = [KeyValue(key=key, value=str(value)) for key, value in figures.items()]
        status = DiagnosticStatus(
            level=level,
            name=status_name(RECORDING, self._hardware),
            message=text,
            hardware_id=self._hardware,
            values=values,
        )
        return DiagnosticArray(status=[status])
