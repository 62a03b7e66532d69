"""The report of the logger in /diagnostics."""

from __future__ import annotations

from collections.abc import Mapping

from diagnostic_msgs.msg import DiagnosticStatus

from planetary_twin_py.recording.ros2.account import TopicAccount

from ..base.diagnostics import Row, checked

RECORDING = "logger: recording"


class RecordingReport:
    """Reports the losses since the previous report."""

    def __init__(self) -> None:
        self._missed = 0

    def row(self, file: str, size: int, accounts: Mapping[str, TopicAccount]) -> Row:
        """
        Return the report on a recording in progress.

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
        fault = f"lost {new} messages" if new else None
        return checked(RECORDING, fault, "records all" if accounts else "idle", figures)


def failure_row(reason: str) -> Row:
    """Return the report on a recording that cannot continue because of `reason`."""
    return Row(RECORDING, DiagnosticStatus.ERROR, reason)
