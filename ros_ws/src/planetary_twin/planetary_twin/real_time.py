"""Tells in /diagnostics whether the simulation keeps up with the wall clock."""

from __future__ import annotations

import time
from collections.abc import Mapping, Sequence

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue

from planetary_twin_py import Change
from planetary_twin_py.tolerance import AffordableTolerance

from .live import Progress, State
from .reports import REAL_TIME

_TOLERATED_LAG = 0.01  # share of the wanted rate; below it the real-time factor is a warning
_SHORTEST = 0.5  # [s] over less than this, one late wake-up would already look like a lag


class RealTimeReport:
    """Compares where a live twin stands now with where it stood at the report before.

    `log` is the twin's, which grows.
    """

    def __init__(
        self, hardware: str, rate_factor: float, log: Sequence[Change], begun: Progress
    ) -> None:
        self._hardware = hardware
        self._rate_factor = rate_factor
        self._log = log
        self._told = 0
        self._begun = self._last = begun
        self._process_cpu = time.process_time()
        self._wall = time.monotonic()

    def message(
        self,
        now: Progress,
        affordable: AffordableTolerance,
        published: Mapping[str, int],
        *,
        last: bool,
    ) -> DiagnosticArray:
        """The report, not stamped yet; `published` counts messages by topic.

        The `last` one is sent when the twin has stopped, so its counts are final.
        """
        recent = _rate(self._last, now, self._rate_factor)
        overruns = now.overruns - self._last.overruns
        lags = recent < (1.0 - _TOLERATED_LAG) * self._rate_factor
        stood = {now.state, self._last.state} != {State.RUNNING}
        late = overruns > 0 or (lags and not stood and now.wall - self._last.wall >= _SHORTEST)
        status = DiagnosticStatus(
            level=DiagnosticStatus.WARN if late else DiagnosticStatus.OK,
            name=REAL_TIME,
            message=f"falls behind: real time x {recent:.3f}, {overruns} overruns"
            if late
            else "keeps up"
            if self._rate_factor
            else "runs as fast as it goes",
            hardware_id=self._hardware,
        )
        figures: dict[str, object] = {
            "state": "stopped" if last else now.state,
            "real_time_factor": f"{recent:.4f}",
            "real_time_factor_mean": f"{_rate(self._begun, now, self._rate_factor):.4f}",
            "rate_factor": f"{self._rate_factor:g}",
            "simulated_time": f"{now.simulated:.6f}",
            "overruns": now.overruns,
            **self._cpu(now),
            "computing": f"{affordable.load:.3f}",
            "mesh_cycles": "repeated" if now.repeats else "computed",
            "tolerance_choice": "automatic" if affordable.automatic else "fixed",
            **self._tolerances(),
            **{f"published.{topic}": count for topic, count in published.items()},
        }
        status.values = [KeyValue(key=key, value=str(value)) for key, value in figures.items()]
        self._last = now
        return DiagnosticArray(status=[status])

    def _tolerances(self) -> dict[str, str]:
        """The tolerance, and each since the report before with the instant it holds from.

        All digits are told: with them a recording can be simulated again.
        """
        log = self._log[: len(self._log)]
        told, self._told = self._told, len(log)
        new = {
            f"tolerance_from.{change.time!r}": repr(change.tolerance)
            for k, change in enumerate(log[told:], told)
            if k == 0 or change.tolerance != log[k - 1].tolerance
        }
        return {"tolerance": repr(log[-1].tolerance), **new}

    def _cpu(self, now: Progress) -> dict[str, str]:
        """Shares of one core since the report before."""
        wall, process = time.monotonic(), time.process_time()
        span = max(wall - self._wall, 1e-9)
        loop = (now.cpu - self._last.cpu) / max(now.wall - self._last.wall, 1e-9)
        shares = {
            "cpu_twin": f"{loop:.3f}",
            "cpu_process": f"{(process - self._process_cpu) / span:.3f}",
        }
        self._wall, self._process_cpu = wall, process
        return shares


def _rate(before: Progress, now: Progress, unknown: float) -> float:
    """Simulated seconds per second of wall time; `unknown` where no time has passed."""
    wall = now.wall - before.wall
    return (now.simulated - before.simulated) / wall if wall > 0 else unknown
