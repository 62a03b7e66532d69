"""Tells in /diagnostics whether the energy ledger of the twin closes."""

from __future__ import annotations

import threading

from diagnostic_msgs.msg import DiagnosticStatus, KeyValue

from planetary_twin_py import Window
from planetary_twin_py.ledger_check import Balance, balance_of_window, ledger_warning

LEDGER = "simulation: energy ledger"


class LedgerReport:
    """
    Judges all intervals since the report before together.

    Intervals come from the twin's thread, reports are made in the node's.
    """

    def __init__(self, hardware: str) -> None:
        self._hardware = hardware
        self._lock = threading.Lock()
        self._balance, self._loosest = Balance(), 0.0

    def add(self, window: Window) -> None:
        """Count an interval in."""
        with self._lock:
            self._balance = self._balance.joined(balance_of_window(window))
            self._loosest = max(self._loosest, window.tolerance)

    def status(self) -> DiagnosticStatus:
        """Return the report; a new one begins."""
        with self._lock:
            balance, loosest = self._balance, self._loosest
            self._balance, self._loosest = Balance(), 0.0
        told = ledger_warning(balance, loosest)
        return DiagnosticStatus(
            level=DiagnosticStatus.WARN if told else DiagnosticStatus.OK,
            name=LEDGER,
            message=told or "closes",
            hardware_id=self._hardware,
            values=[
                KeyValue(key="residual", value=f"{balance.residual:.6g}"),
                KeyValue(key="loss", value=f"{balance.loss:.6g}"),
                KeyValue(key="excess", value=f"{balance.excess:.6g}"),
            ],
        )
