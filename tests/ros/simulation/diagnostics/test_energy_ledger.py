"""The report on the energy ledger in /diagnostics."""

from __future__ import annotations

from dataclasses import replace

from diagnostic_msgs.msg import DiagnosticStatus
from planetary_twin.simulation.diagnostics.energy_ledger import LEDGER, LedgerReport

import planetary_twin_py as pt


def test_an_open_ledger_warns_until_the_next_report() -> None:
    twin = pt.Twin(pt.load_scene("paper"), tolerance=1e-3)
    windows = [twin.advance(0.01) for _ in range(3)]
    report = LedgerReport("/twin")
    for window in windows:
        report.add(window)
    sound = report.status()
    assert (sound.name, sound.hardware_id) == (f"twin/{LEDGER}", "/twin")
    assert (sound.level, sound.message) == (DiagnosticStatus.OK, "closes")
    assert float({item.key: item.value for item in sound.values}["excess"]) < 1.0
    for window in windows:
        report.add(replace(window, residual_power=0.05 * window.power_loss))
    bad = report.status()
    assert bad.level == DiagnosticStatus.WARN
    assert bad.message.startswith("the energy ledger does not balance: ")
    assert bad.message.endswith("tighten the tolerance from 0.001 to 0.0001")
    assert report.status().level == DiagnosticStatus.OK
