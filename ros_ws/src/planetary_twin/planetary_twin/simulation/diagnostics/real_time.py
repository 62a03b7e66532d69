"""Reports in /diagnostics whether the simulation keeps up with the wall clock."""

from __future__ import annotations

import time
from collections.abc import Mapping
from typing import NamedTuple

from diagnostic_msgs.msg import DiagnosticStatus

from planetary_twin_py import Change
from planetary_twin_py.recording.ros2.topics import REAL_TIME
from planetary_twin_py.run.quality_control import QualityControl

from ...base.diagnostics import Row
from ..progress import Progress, State
from ..publishing.stamps import Stamps

_TOLERATED_LAG = 0.01  # share of the rate factor; a larger lag is a warning
_TOLERATED_INTERVALS = 2.0  # lag that the instants of two reports within intervals can cause
_BROKEN = 0.5  # share of the rate factor; a lower real-time factor is an error
_SHORTEST = 0.5  # [s] in a shorter time, one late wake-up would look like a lag
_LONGEST_LAG = 0.1  # [s] of stamps behind ROS time; consumers of stamps beside it reject more
_SLOWEST = 0.001  # [s/s] growth of a lag that is stated
_STALL = 2.0  # [s] beyond its period, after which an interval may never end


class Verdict(NamedTuple):
    """Level and message of a report."""

    level: bytes
    text: str


RUNS_FREELY = Verdict(DiagnosticStatus.OK, "runs as fast as possible")
KEEPS_UP = Verdict(DiagnosticStatus.OK, "keeps up")
PAUSED = Verdict(DiagnosticStatus.OK, "paused")
WAITS = Verdict(DiagnosticStatus.OK, "waits")
WAITS_LONG = Verdict(DiagnosticStatus.WARN, "waits")
THINNED = Verdict(DiagnosticStatus.WARN, "keeps up with a thinned waveform")
LATE = Verdict(DiagnosticStatus.WARN, "keeps up, but its stamps are late")
FALLS_BEHIND = Verdict(DiagnosticStatus.WARN, "falls behind")
FALLS_FAR_BEHIND = Verdict(DiagnosticStatus.ERROR, "falls far behind")
FAILED = Verdict(DiagnosticStatus.ERROR, "failed")
STALLED = Verdict(DiagnosticStatus.STALE, "stalled")


class RealTimeReport:
    """
    Compares the progress of a live twin with that at the previous report.

    `rate_factor` is the requested simulated seconds per second, `period` [s] the wall time of an
    interval, `start` the progress at the start. `log` is that of the twin; reported changes are
    removed from it, because ramps add changes for hours.
    """

    def __init__(
        self, rate_factor: float, period: float, log: list[Change], start: Progress
    ) -> None:
        self._rate_factor = rate_factor
        self._period = period
        self._log = log
        self._reported: Change | None = None
        self._changes = {"tolerance": 0, "sample_rate": 0}
        self._start = self._last = start
        self._waited = False  # at the previous report
        self._lag = 0.0  # [s] at the previous report
        self._skips, self._skipped = 0, 0.0  # number and total [s] of skips
        self._process_cpu = time.process_time()
        self._wall = time.monotonic()
        self.verdict = KEEPS_UP

    def row(
        self,
        now: Progress,
        quality: QualityControl,
        published: Mapping[str, int],
        stamps: Stamps,
        *,
        last: bool,
    ) -> Row:
        """
        Return the report.

        `now` is the progress, `quality` the quality control, `published` the number of messages by
        topic, `stamps` are those of the intervals. The `last` report is sent when the twin has
        stopped, so its counts are final.
        """
        lasted = now.lasted - self._last.lasted
        idle = 0.0 if now.state != State.RUNNING else self._rate_factor
        recent = _ratio(now.ran - self._last.ran, lasted, idle)
        overruns = now.overruns - self._last.overruns
        silence = time.monotonic() - now.wall
        lag, growth = stamps.lag, _ratio(stamps.lag - self._lag, lasted, 0.0)
        late = lag if self._rate_factor == 1.0 else 0.0  # other rates leave ROS time on purpose
        self.verdict = self._judge(now, quality, recent, 0.0 if last else silence, late)
        if self.verdict == STALLED:
            recent = 0.0
        behind = f"real-time factor {recent:.3f}, {overruns} overruns"
        if late > _LONGEST_LAG:
            behind += f", stamps {lag:.2f} s behind ROS time"
        grows = f", growing by {growth:.3f} s/s" if growth >= _SLOWEST else ""
        details = {
            LATE: f"{lag:.2f} s behind ROS time{grows}: a pause ends the lag, and max_lag limits "
            "it",
            THINNED: f"{self._log[-1].sample_rate:g} of {quality.full_sample_rate:g} Hz",
            FALLS_BEHIND: behind,
            FALLS_FAR_BEHIND: behind,
            WAITS_LONG: "for the first message on /clock, or for the node that wait_for names",
            FAILED: f"{now.failure}; ~/reset starts a new run with the parameters",
            STALLED: f"the interval in progress has not ended for {silence:.1f} s",
        }
        parts = [self.verdict.text, details.get(self.verdict, "")]
        figures: dict[str, object] = {
            "state": "stopped" if last else now.state,
            "failure": now.failure,
            "real_time_factor": f"{recent:.4f}",
            "real_time_factor_mean": f"{self._mean(now):.4f}",
            "rate_factor": f"{self._rate_factor:g}",
            "simulated_time": f"{now.simulated:.6f}",
            "overruns": now.overruns,
            "held": f"{now.held:.3f}",
            "stamp_lag": f"{lag:.3f}",
            "stamp_lag_growth": f"{growth:.4f}",
            **self._skips_of(stamps),
            **self._cpu(now),
            "computing": f"{quality.load:.3f}",
            "mesh_cycles": "repeated" if now.repeats else "computed",
            "tolerance_choice": "automatic" if quality.automatic else "fixed",
            "waveform": "full"
            if self._log[-1].sample_rate == quality.full_sample_rate
            else "thinned",
            **self._settings(),
            **{f"published.{topic}": count for topic, count in published.items()},
        }
        self._last, self._lag = now, lag
        return Row(REAL_TIME, self.verdict.level, ": ".join(filter(None, parts)), figures)

    def _judge(
        self,
        now: Progress,
        quality: QualityControl,
        recent: float,
        silence: float,
        late: float,
    ) -> Verdict:
        if now.state == State.FAILED:
            return FAILED
        if silence > self._period + _STALL:
            return STALLED
        if now.state == State.PAUSED:
            return PAUSED
        waited, self._waited = self._waited, now.state == State.WAITING
        if self._waited:
            return WAITS_LONG if waited else WAITS  # a short wait precedes every run
        if not self._rate_factor:
            return RUNS_FREELY
        lasted = now.lasted - self._last.lasted
        if lasted >= _SHORTEST:
            if recent < _BROKEN * self._rate_factor:
                return FALLS_FAR_BEHIND
            lag = lasted * (1.0 - recent / self._rate_factor)
            if lag > max(_TOLERATED_LAG * lasted, _TOLERATED_INTERVALS * self._period):
                return FALLS_BEHIND
        if now.overruns > self._last.overruns:
            return FALLS_BEHIND
        if late > _LONGEST_LAG:
            return LATE
        thinned = self._log[-1].sample_rate < quality.full_sample_rate
        return THINNED if thinned else KEEPS_UP

    def _mean(self, now: Progress) -> float:
        ran, lasted = now.ran - self._start.ran, now.lasted - self._start.lasted
        return _ratio(ran, lasted, self._rate_factor)

    def _settings(self) -> dict[str, object]:
        """
        Return the tolerance and the sample rate of the waveform, and the number of their changes.

        Each change since the previous report is included with its instant and with all digits, so
        that a recording can be simulated again.
        """
        log, before = self._log[:], self._reported
        new: dict[str, object] = {}
        for change in log:
            for name in self._changes:
                value = getattr(change, name)
                if before is None or value != getattr(before, name):
                    new[f"{name}_from.{change.time!r}"] = repr(value)
                    self._changes[name] += before is not None
            before = change
        self._reported = before
        del self._log[: len(log) - 1]  # the last change is still in force
        for name, count in self._changes.items():
            new[name] = repr(getattr(log[-1], name))
            new[f"{name}_changes"] = count
        return new

    def _skips_of(self, stamps: Stamps) -> dict[str, object]:
        """Return number and total of the skips of stamps, and each one since the last report."""
        new: dict[str, object] = {}
        while stamps.skips:
            skip = stamps.skips.popleft()
            new[f"skip.{skip.time!r}"] = f"{skip.lag:.9f}"
            self._skips += 1
            self._skipped += skip.lag
        return {"skips": self._skips, "skipped": f"{self._skipped:.3f}", **new}

    def _cpu(self, now: Progress) -> dict[str, str]:
        """Return the shares of one core since the previous report."""
        wall, process = time.monotonic(), time.process_time()
        span = max(wall - self._wall, 1e-9)
        loop = (now.cpu - self._last.cpu) / max(now.wall - self._last.wall, 1e-9)
        shares = {
            "cpu_twin": f"{loop:.3f}",
            "cpu_process": f"{(process - self._process_cpu) / span:.3f}",
        }
        self._wall, self._process_cpu = wall, process
        return shares


def _ratio(simulated: float, wall: float, unknown: float) -> float:
    """Return simulated seconds per second of wall time; `unknown` if no wall time has passed."""
    return simulated / wall if wall > 0.0 else unknown
