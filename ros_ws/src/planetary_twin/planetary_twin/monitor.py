"""A running twin as a table in the terminal, each quantity with its recent history."""

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

from planetary_twin_py.terminal.console import make_console

from .remote import Remote
from .reports import real_time_figures

_BARS = "▁▂▃▄▅▆▇█"
_HISTORY = 40  # values that a sparkline shows
_LIVE_PERIOD = 0.25  # [s] between two values in a terminal
_PLAIN_PERIOD = 1.0  # [s] between two tables in a file or a pipe
_SILENCE = 10.0  # [s] longest wait for a state


class Figure(NamedTuple):
    """One row of the table."""

    name: str
    unit: str
    value: Callable[[GearboxState], float]


def _rpm(speed: float) -> float:
    return speed * 30.0 / math.pi


def _mean(values: object) -> float:
    """Return the mean over the planets; entries beyond their number are NaN."""
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
    """Return a bar for each of `values`, scaled to their range; a blank for NaN."""
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
    """Subscribes to a twin in `namespace` and keeps the recent history of its quantities."""

    def __init__(self, namespace: str) -> None:
        super().__init__(namespace)
        self.state: GearboxState | None = None
        self.report: dict[str, str] = {}
        self._histories = [deque[float](maxlen=_HISTORY) for _ in FIGURES]
        self.node.create_subscription(GearboxState, "gearbox_state", self._on_state, 10)
        self.node.create_subscription(DiagnosticArray, "/diagnostics", self._on_diagnostics, 10)

    def table(self) -> Table:
        """Return the present table; raises `ConnectionError` if no state has been received."""
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
        table.add_column("history")
        for figure, history in zip(FIGURES, self._histories, strict=True):
            value = figure.value(state)
            history.append(value)
            shown = "-" if math.isnan(value) else f"{value:.5g}"
            table.add_row(figure.name, shown, figure.unit, sparkline(list(history)))
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

    def _on_state(self, message: GearboxState) -> None:
        self.state = message

    def _on_diagnostics(self, message: DiagnosticArray) -> None:
        self.report = real_time_figures(message, self.namespace) or self.report


def watch(namespace: str, duration: float | None) -> None:
    """Show the twin in `namespace` for `duration` [s]; None: until interrupted."""
    console = make_console()
    with Monitor(namespace) as monitor:
        with console.status(f"looking for a twin in {monitor.namespace}"):
            monitor.wait(lambda: monitor.state is not None, _SILENCE)
        end = math.inf if duration is None else time.monotonic() + duration
        if not console.is_terminal:
            _print(monitor, console, end)
            return
        with Live(monitor.table(), console=console, refresh_per_second=8) as live:
            while time.monotonic() < end:
                time.sleep(_LIVE_PERIOD)
                live.update(monitor.table())


def _print(monitor: Monitor, console: Console, end: float) -> None:
    """Print a table once a second, for a file or a pipe."""
    console.print(monitor.table())
    while time.monotonic() + _PLAIN_PERIOD < end:
        time.sleep(_PLAIN_PERIOD)
        console.print(monitor.table())
