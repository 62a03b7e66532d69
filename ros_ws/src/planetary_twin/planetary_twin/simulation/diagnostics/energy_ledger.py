"""Reports in /diagnostics whether the energy ledger of the twin closes."""

from __future__ import annotations

import threading

from diagnostic_msgs.msg import DiagnosticStatus, KeyValue

from planetary_twin_py import Window
from planetary_twin_py.checks.ledger import Balance, balance_of_window, ledger_warning
from planetary_twin_py.recording.ros2.topics import status_name

LEDGER = "simulation: energy ledger"


class LedgerReport:
    """
    Checks the intervals since the last report as one run.

    The twin's thread adds intervals; the node's thread takes reports. `hardware` is the namespace
    of the twin, the `hardware_id` of the status.
    """

    def __init__(self, hardware: str) -> None:
        self._hardware = hardware
        self._lock = threading.Lock()
        self._balance, self._loosest = Balance(), 0.0

    def add(self, window: Window) -> None:
        """Add an interval."""
        with self._lock:
            self._balance = self._balance.joined(balance_of_window(window))
            self._loosest = max(self._loosest, window.tolerance)

    def status(self) -> DiagnosticStatus:
        """Return the report on the intervals added since the last report."""
        with self._lock:
            balance, loosest = self._balance, self._loosest
            self._balance, self._loosest = Balance(), 0.0
        warning = ledger_warning(balance, loosest)
        return DiagnosticStatus(
            level=DiagnosticStatus.WARN if warning else DiagnosticStatus.OK,
            name=status_name(LEDGER, self._hardware),
            message=warning or "closes",
            hardware_id=self._hardware,
            values=[
                KeyValue(key="residual", value=f"{balance.residual:.6g}"),
                KeyValue(key="loss", value=f"{balance.loss:.6g}"),
                KeyValue(key="excess", value=f"{balance.excess:.6g}"),
            ],
        )
