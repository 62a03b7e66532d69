"""Reports in /diagnostics whether the results of the twin are consistent with its tolerance."""

from __future__ import annotations

import threading

from diagnostic_msgs.msg import DiagnosticStatus, KeyValue

from planetary_twin_py import Window
from planetary_twin_py.checks.accuracy import course_warnings
from planetary_twin_py.recording.ros2.topics import status_name
from planetary_twin_py.run.counters import Course

ACCURACY = "simulation: accuracy"


class AccuracyReport:
    """
    Checks the intervals since the last report as one run.

    The twin's thread adds intervals; the node's thread takes reports. `hardware` is the namespace
    of the twin, the `hardware_id` of the status. `lasting` is a warning that applies to all
    intervals, until it is replaced.
    """

    def __init__(self, hardware: str) -> None:
        self._hardware = hardware
        self._lock = threading.Lock()
        self._course = Course()
        self.lasting: str | None = None

    def add(self, window: Window) -> None:
        """Add an interval."""
        with self._lock:
            self._course = self._course.joined(window.course)

    def status(self) -> DiagnosticStatus:
        """Return the report on the intervals added since the last report."""
        with self._lock:
            course, self._course = self._course, Course()
        warnings = [self.lasting] if self.lasting else []
        warnings += course_warnings(course)
        return DiagnosticStatus(
            level=DiagnosticStatus.WARN if warnings else DiagnosticStatus.OK,
            name=status_name(ACCURACY, self._hardware),
            message="; also: ".join(warnings) or "consistent with the tolerance",
            hardware_id=self._hardware,
            values=[
                KeyValue(key=name, value=f"{getattr(course, name):.6g}")
                for name in ("unsettled", "reversals", "both_flanks", "unrepeated_flank_events")
            ],
        )
