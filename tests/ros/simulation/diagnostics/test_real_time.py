"""The real-time report in /diagnostics, from the progress of a live twin."""

import time
from collections import deque
from types import SimpleNamespace

import pytest
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from planetary_twin.base.diagnostics import diagnostics
from planetary_twin.simulation.diagnostics.real_time import RealTimeReport
from planetary_twin.simulation.progress import Progress, State
from planetary_twin.simulation.publishing.stamps import Skip

import planetary_twin_py as pt
from planetary_twin_py.run.quality_control import QualityControl, Setting, settings_of

from ...reported import figures

PERIOD, FULL = 0.01, 50e3
POINT = pt.load_scene("paper").operating_point
AFFORDABLE = QualityControl(settings_of((1e-3,), FULL), 0.4, PERIOD, Setting(1e-3, FULL))


class Reports:
    """Reports of a twin that was at simulated time 0 s ten seconds ago."""

    def __init__(self) -> None:
        self.log = [pt.Change(0.0, POINT, 1e-3, FULL)]
        self.stamps = SimpleNamespace(lag=0.0, skips=deque[Skip]())
        self._now = time.monotonic()
        started = Progress(0.0, self._now - 10.0, 0.0, 0.0, 0.0, 0, False, State.RUNNING)
        self._report = RealTimeReport(1.0, PERIOD, self.log, started)

    def __call__(
        self,
        simulated: float,
        ago: float,
        *,
        overruns: int = 0,
        state: State = State.RUNNING,
        last: bool = False,
    ) -> DiagnosticArray:
        lasted = 10.0 - ago if state == State.RUNNING else simulated
        wall = self._now - ago
        now = Progress(simulated, wall, simulated, lasted, 0.0, overruns, False, state)
        return self.at(now, last=last)

    def at(self, now: Progress, *, last: bool = False) -> DiagnosticArray:
        row = self._report.row(now, AFFORDABLE, {}, self.stamps, last=last)
        return diagnostics([row], "/twin")


@pytest.mark.parametrize(
    ("simulated", "ago", "more", "level", "text"),
    [
        (10.0, 0.0, {}, DiagnosticStatus.OK, "keeps up"),
        (9.0, 0.0, {}, DiagnosticStatus.WARN, "falls behind: real-time factor 0.900, 0 overruns"),
        (9.981, 0.0, {}, DiagnosticStatus.OK, "keeps up"),
        (
            10.0,
            0.0,
            {"overruns": 3},
            DiagnosticStatus.WARN,
            "falls behind: real-time factor 1.000, 3 ",
        ),
        (4.0, 0.0, {}, DiagnosticStatus.ERROR, "falls far behind: real-time factor 0.400"),
        (4.0, 0.0, {"state": State.PAUSED}, DiagnosticStatus.OK, "paused"),
        (4.0, 3.0, {"state": State.FAILED}, DiagnosticStatus.ERROR, "failed: "),
        (7.0, 3.0, {}, DiagnosticStatus.STALE, "stalled: the interval in progress has"),
        (7.0, 3.0, {"last": True}, DiagnosticStatus.OK, "keeps up"),
    ],
)
def test_the_level_says_how_far_behind_the_twin_is(simulated, ago, more, level, text):
    status = Reports()(simulated, ago, **more).status[0]
    assert status.level == level
    assert status.message.startswith(text)


def test_late_stamps_are_a_warning_with_their_lag_and_its_growth():
    reports = Reports()
    reports.stamps.lag = 0.09
    assert reports(9.0, 1.0).status[0].level == DiagnosticStatus.OK
    reports.stamps.lag = 8.79
    status = reports(10.0, 0.0).status[0]
    assert status.level == DiagnosticStatus.WARN
    assert "stamps are late: 8.79 s behind ROS time, growing by 8.700 s/s" in status.message
    reports.stamps.lag = 8.78
    assert "8.78 s behind ROS time: a pause ends the lag" in reports(11.0, -1.0).status[0].message


def test_each_skip_of_stamps_is_reported_once():
    reports = Reports()
    reports.stamps.skips += [Skip(3.1, 8.75), Skip(4.0, 0.25)]
    first, second = (figures([reports(10.0, 0.0)]) for _ in range(2))
    assert (first["skip.3.1"], first["skip.4.0"]) == ("8.750000000", "0.250000000")
    assert not any(key.startswith("skip.") for key in second)
    assert (second["skips"], second["skipped"]) == ("2", "9.000")


def test_a_wait_from_one_report_to_the_next_is_a_warning():
    reports = Reports()
    at_start = reports(0.0, 0.0, state=State.WAITING).status[0]
    assert at_start.level == DiagnosticStatus.OK and at_start.message == "waits"
    still = reports(0.0, 0.0, state=State.WAITING).status[0]
    assert still.level == DiagnosticStatus.WARN
    assert still.message.startswith("waits: for the first message on /clock")
    assert reports(10.0, 0.0).status[0].level == DiagnosticStatus.OK


def test_pauses_are_no_part_of_the_mean():
    """Nine seconds of waiting, or of a pause, and one at half the rate."""
    reports = Reports()
    now = Progress(0.5, time.monotonic(), 0.5, 1.0, 0.0, 0, False, State.RUNNING)
    assert figures([reports.at(now)])["real_time_factor_mean"] == "0.5000"


def test_a_thinned_waveform_is_a_warning_though_it_keeps_up():
    reports = Reports()
    reports.log.append(pt.Change(1.0, POINT, 1e-3, 12.5e3))
    message = reports(10.0, 0.0)
    assert message.status[0].level == DiagnosticStatus.WARN
    assert message.status[0].message == "keeps up with a thinned waveform: 12500 of 50000 Hz"


def test_each_change_is_reported_once_and_then_removed():
    reports = Reports()
    reports.log.append(pt.Change(0.5, POINT, 1e-2, FULL))
    reports.log.append(pt.Change(0.5, POINT, 1e-2, 25e3))
    reported = figures([reports(9.0, 1.0)])
    since = {key: value for key, value in reported.items() if "_from." in key}
    assert since == {
        "tolerance_from.0.0": "0.001",
        "sample_rate_from.0.0": "50000.0",
        "tolerance_from.0.5": "0.01",
        "sample_rate_from.0.5": "25000.0",
    }
    assert (reported["tolerance_changes"], reported["sample_rate_changes"]) == ("1", "1")
    assert len(reports.log) == 1
    reports.log.append(pt.Change(9.5, POINT, 1e-2, FULL))
    reported = figures([reports(10.0, 0.0)])
    assert {key for key in reported if "_from." in key} == {"sample_rate_from.9.5"}
    assert (reported["tolerance_changes"], reported["sample_rate_changes"]) == ("1", "2")
