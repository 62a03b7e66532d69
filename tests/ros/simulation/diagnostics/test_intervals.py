"""The reports on computed intervals in /diagnostics."""

from dataclasses import replace

from diagnostic_msgs.msg import DiagnosticStatus
from planetary_twin.base.diagnostics import diagnostics
from planetary_twin.simulation.diagnostics.intervals import ACCURACY, LEDGER, IntervalReports

import planetary_twin_py as pt


def statuses(reports: IntervalReports) -> list[DiagnosticStatus]:
    """Ledger and accuracy."""
    return diagnostics(reports.rows(), "/twin").status


def test_inaccurate_intervals_warn_until_the_next_report():
    window = pt.Twin(pt.load_scene("paper"), tolerance=1e-3).advance(0.01)
    reports = IntervalReports()
    reports.add(window)
    sound = statuses(reports)[1]
    assert (sound.name, sound.hardware_id) == (f"twin/{ACCURACY}", "/twin")
    assert (sound.level, sound.message) == (DiagnosticStatus.OK, "consistent with the tolerance")
    for _ in range(2):
        reports.add(replace(window, course=window.course._replace(reversals=3)))
    bad = statuses(reports)[1]
    assert bad.level == DiagnosticStatus.WARN
    assert bad.message.startswith("vibration stops gears relative to the carrier, or slows")
    assert " in 6 steps: " in bad.message
    assert {item.key: item.value for item in bad.values}["reversals"] == "6"
    assert statuses(reports)[1].level == DiagnosticStatus.OK


def test_an_open_ledger_warns_until_the_next_report():
    twin = pt.Twin(pt.load_scene("paper"), tolerance=1e-3)
    windows = [twin.advance(0.01) for _ in range(3)]
    reports = IntervalReports()
    for window in windows:
        reports.add(window)
    sound = statuses(reports)[0]
    assert (sound.name, sound.hardware_id) == (f"twin/{LEDGER}", "/twin")
    assert (sound.level, sound.message) == (DiagnosticStatus.OK, "closes")
    assert float({item.key: item.value for item in sound.values}["excess"]) < 1.0
    for window in windows:
        reports.add(replace(window, residual_power=0.05 * window.power_loss))
    bad = statuses(reports)[0]
    assert bad.level == DiagnosticStatus.WARN
    assert bad.message.startswith("the energy ledger does not balance: ")
    assert bad.message.endswith("tighten the tolerance from 0.001 to 0.0001")
    assert statuses(reports)[0].level == DiagnosticStatus.OK
