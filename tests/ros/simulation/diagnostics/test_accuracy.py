"""The accuracy report in /diagnostics."""

from __future__ import annotations

from dataclasses import replace

from diagnostic_msgs.msg import DiagnosticStatus
from planetary_twin.simulation.diagnostics.accuracy import ACCURACY, AccuracyReport

import planetary_twin_py as pt


def test_inaccurate_intervals_warn_until_the_next_report() -> None:
    window = pt.Twin(pt.load_scene("paper"), tolerance=1e-3).advance(0.01)
    report = AccuracyReport("/twin")
    report.add(window)
    sound = report.status()
    assert (sound.name, sound.hardware_id) == (f"twin/{ACCURACY}", "/twin")
    assert (sound.level, sound.message) == (DiagnosticStatus.OK, "consistent with the tolerance")
    for _ in range(2):
        report.add(replace(window, course=window.course._replace(reversals=3)))
    bad = report.status()
    assert bad.level == DiagnosticStatus.WARN
    assert bad.message.startswith("vibration stops gears relative to the carrier, or slows")
    assert " in 6 steps: " in bad.message
    assert {item.key: item.value for item in bad.values}["reversals"] == "6"
    assert report.status().level == DiagnosticStatus.OK
