"""What the logger tells of itself in /diagnostics."""

from __future__ import annotations

from collections.abc import Mapping

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue

from planetary_twin_py.recording.ros2.account import TopicAccount
from planetary_twin_py.recording.ros2.topics import status_name

RECORDING = "logger: recording"


class RecordingReport:
    """Judges the losses since the report before; `hardware` is the logger's namespace."""

    def __init__(self, hardware: str) -> None:
        self._hardware = hardware
        self._missed = 0

    def message(
        self, file: str, size: int, accounts: Mapping[str, TopicAccount]
    ) -> DiagnosticArray:
        """Return the report, not stamped yet, of a recording that goes on."""
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
        """Return the report of a recording that cannot go on."""
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
