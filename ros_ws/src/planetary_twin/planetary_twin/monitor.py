"""A running twin as a table in the terminal, each figure with its recent course."""

from __future__ import annotations

import math
import time
from collections import deque
from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from diagnostic_msgs.msg import DiagnosticArray
from planetary_twin_msgs.msg import GearboxState
from rich.console import Console
from rich.live import Live
from rich.table import Table

from planetary_twin_py.cli._console import make_console

from .remote import Remote
from .reports import real_time_figures

_BARS = "▁▂▃▄▅▆▇█"
_COURSE = 40  # looks that a course shows
_LOOK = 0.25  # [s] between two of them
_PLAIN = 1.0  # [s] between two where nobody watches a terminal
_SILENCE = 10.0  # [s] longest wait for a state


class Figure(NamedTuple):
    """One line of the table."""

    name: str
    unit: str
    value: Callable[[GearboxState], float]


def _rpm(speed: float) -> float:
    return speed * 30.0 / math.pi


def _mean(values: object) -> float:
    """Of the planets there are."""
    array = np.asarray(values, dtype=float)
    return float(np.nanmean(array)) if np.isfinite(array).any() else math.nan


FIGURES = (
    Figure("input speed", "rpm", lambda s: _rpm(s.input_speed)),
    Figure("input torque", "N m", lambda s: s.input_torque),
    Figure("output speed", "rpm", lambda s: _rpm(s.output_speed)),
    Figure("mesh frequency", "Hz", lambda s: s.mesh_frequency),
    Figure("DTE sun-planet, mean", "um", lambda s: 1e6 * _mean(s.sun_planet_dte_mean)),
    Figure("DTE sun-planet, rms", "um", lambda s: 1e6 * _mean(s.sun_planet_dte_rms)),
    Figure("DTE planet-ring, mean", "um", lambda s: 1e6 * _mean(s.planet_ring_dte_mean)),
    Figure("mesh force sun-planet, mean", "N", lambda s: _mean(s.sun_planet_mesh_force_mean)),
    Figure(
        "mesh force sun-planet, peak",
        "N",
        lambda s: float(np.nanmax(s.sun_planet_mesh_force_peak)),
    ),
    Figure("in contact, sun-planet", "%", lambda s: 100.0 * _mean(s.sun_planet_contact_fraction)),
    Figure("film, sun-planet", "um", lambda s: 1e6 * _mean(s.sun_planet_film_thickness)),
    Figure("lambda ratio, sun-planet", "-", lambda s: _mean(s.sun_planet_lambda_ratio)),
    Figure("boundary friction, sun-planet", "N", lambda s: _mean(s.sun_planet_boundary_friction)),
    Figure("viscous friction, sun-planet", "N", lambda s: _mean(s.sun_planet_viscous_friction)),
    Figure("power loss", "W", lambda s: s.power_loss),
    Figure("efficiency", "%", lambda s: 100.0 * s.efficiency),
)


def sparkline(values: list[float]) -> str:
    """Draw a bar for each value from the least to the greatest; a blank where there is none."""
    finite = [value for value in values if math.isfinite(value)]
    if not finite:
        return ""
    low, span = min(finite), max(finite) - min(finite)
    steps = [
        round((len(_BARS) - 1) * (v - low) / span) if span > 0.0 else 0
        for v in values
        if math.isfinite(v)
    ]
    heights = iter(steps)
    return "".join(_BARS[next(heights)] if math.isfinite(value) else " " for value in values)


class Monitor(Remote):
    """Hears a twin and keeps the recent course of its figures."""

    def __init__(self, namespace: str) -> None:
        super().__init__(namespace)
        self.state: GearboxState | None = None
        self.report: dict[str, str] = {}
        self._courses = [deque[float](maxlen=_COURSE) for _ in FIGURES]
        self.node.create_subscription(GearboxState, "gearbox_state", self._hear, 10)
        self.node.create_subscription(DiagnosticArray, "/diagnostics", self._diagnose, 10)

    def look(self) -> Table:
        """Return the table of now."""
        state = self.state
        if state is None:
            raise ConnectionError(
                f"no twin publishes in {self.namespace}: start one with `planetary-twin run`"
            )
        report = self.report
        table = Table(box=None, header_style="bold", pad_edge=False)
        table.add_column(f"{self.namespace}  {state.simulated_time:.2f} s")
        table.add_column("value", justify="right")
        table.add_column("")
        table.add_column("course")
        for figure, course in zip(FIGURES, self._courses, strict=True):
            value = figure.value(state)
            course.append(value)
            shown = "-" if math.isnan(value) else f"{value:.5g}"
            table.add_row(figure.name, shown, figure.unit, sparkline(list(course)))
        table.add_section()
        for name, key in (
            ("real time x", "real_time_factor"),
            ("overruns", "overruns"),
            ("tolerance", "tolerance"),
            ("waveform, Hz", "sample_rate"),
            ("mesh cycles", "mesh_cycles"),
            ("state", "state"),
        ):
            table.add_row(name, report.get(key, "-"), "", "")
        return table

    def _hear(self, message: GearboxState) -> None:
        self.state = message

    def _diagnose(self, message: DiagnosticArray) -> None:
        self.report = real_time_figures(message, self.namespace) or self.report


def watch(namespace: str, duration: float | None) -> None:
    """Show the twin for `duration` [s], or until interrupted."""
    console = make_console()
    with Monitor(namespace) as monitor:
        with console.status(f"looking for a twin in {monitor.namespace}"):
            monitor.wait(lambda: monitor.state is not None, _SILENCE)
        end = math.inf if duration is None else time.monotonic() + duration
        if not console.is_terminal:
            _print(monitor, console, end)
            return
        with Live(monitor.look(), console=console, refresh_per_second=8) as live:
            while time.monotonic() < end:
                time.sleep(_LOOK)
                live.update(monitor.look())


def _print(monitor: Monitor, console: Console, end: float) -> None:
    """Print a table now and then, for a file or a pipe."""
    console.print(monitor.look())
    while time.monotonic() + _PLAIN < end:
        time.sleep(_PLAIN)
        console.print(monitor.look())
