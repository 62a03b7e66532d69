"""A running twin as a table in the terminal, each quantity with its recent history."""

from __future__ import annotations

import math
import time
from collections import deque
from collections.abc import Iterable, Iterator
from typing import NamedTuple

import numpy as np
from diagnostic_msgs.msg import DiagnosticArray
from planetary_twin_msgs.msg import AxesState, FollowerEstimate, FollowerEvent, GearboxState
from rich.console import Console
from rich.live import Live
from rich.table import Table

from planetary_twin_py.recording.ros2.topics import AXES_STATE
from planetary_twin_py.terminal.console import make_console
from planetary_twin_py.units.catalogue import BEARING, MESH, SHARING, TRAIN, Quantity, side_title

from ..base.diagnostics import real_time_figures
from ..base.qos import LATCHED
from .remote import Remote

_BARS = "▁▂▃▄▅▆▇█"
_HISTORY = 40  # values that a sparkline shows
_LEAST_SWING = 0.01  # of the largest value: a smaller swing does not fill the height of the bars
_LIVE_PERIOD = 0.25  # [s] between two values in a terminal
_PLAIN_PERIOD = 1.0  # [s] between two tables in a file or a pipe
_SILENCE = 10.0  # [s] longest wait for a state


class Figure(NamedTuple):
    """One row of the table: a field of a message and its entry in the catalogue."""

    field: str
    title: str
    quantity: Quantity

    def value(self, state: GearboxState | AxesState) -> float:
        """Return the value in the unit of plots, of all meshes of one kind; NaN if unknown."""
        values = np.atleast_1d(np.asarray(getattr(state, self.field), dtype=float))
        known = values[np.isfinite(values)]  # entries beyond the number of planets are NaN
        return self.quantity.factor * self.quantity.of_meshes(known) if known.size else math.nan


def _of_train(name: str) -> Figure:
    return Figure(name, TRAIN[name].title, TRAIN[name])


def _of_meshes(side: str, name: str) -> Figure:
    return Figure(f"{side}_{name}", f"{MESH[name].title}, {side_title(side)}", MESH[name])


FIGURES = (
    *map(_of_train, ("input_speed", "input_torque", "output_speed", "mesh_frequency")),
    *(_of_meshes("sun_planet", name) for name in MESH if name != "power_loss"),
    _of_meshes("planet_ring", "dte_mean"),
    *map(_of_train, ("power_loss", "efficiency")),
)
OF_AXES = (
    Figure("load_sharing_factor", "Load sharing factor", SHARING["load_sharing_factor"]),
    *(
        Figure(f"{body}_{name}", f"{title}, {body}", BEARING[name]._replace(over_meshes="max"))
        for name, title in (
            ("displacement_peak", "Displacement, peak"),
            ("bearing_force_peak", "Bearing force, peak"),
        )
        for body in ("sun", "planet")
    ),
)
"""Further rows, if the axes of the twin move."""

_REPORTED = (
    ("Real-time factor", "real_time_factor", ""),
    ("Overruns", "overruns", ""),
    ("Tolerance", "tolerance", ""),
    ("Sample rate of the waveform", "sample_rate", "Hz"),
    ("Mesh cycles, computed or repeated", "mesh_cycles", ""),
    ("State of the node", "state", ""),
)
# Characters of a row beside its history: title, value, unit and the space between them.
_BESIDE_HISTORY = max(len(figure.title) for figure in (*FIGURES, *OF_AXES)) + 18


def sparkline(values: list[float]) -> str:
    """
    Return a bar for each of `values`; a blank for NaN.

    The bars are scaled to the range of the values, but at least to `_LEAST_SWING` of the largest
    magnitude, so that rounding of a constant is not drawn as a swing.
    """
    finite = [value for value in values if math.isfinite(value)]
    if not finite:
        return ""
    low = min(finite)
    span = max(max(finite) - low, _LEAST_SWING * max(map(abs, finite)))
    steps = [
        round((len(_BARS) - 1) * (v - low) / span) if span > 0.0 else 0
        for v in values
        if math.isfinite(v)
    ]
    heights = iter(steps)
    return "".join(_BARS[next(heights)] if math.isfinite(value) else " " for value in values)


class Pair(NamedTuple):
    """A measured quantity and its simulated value."""

    title: str
    unit: str
    measured: float
    simulated: float

    @property
    def residual(self) -> float:
        """Measured minus simulated value."""
        return self.measured - self.simulated


def pairs(estimate: FollowerEstimate, state: GearboxState) -> list[Pair]:
    """Return torque, speed and loss of a gearbox and of its twin, in SI."""
    loss = estimate.loss_torque * abs(estimate.input_speed)
    return [
        Pair("Input torque, measured", "N m", estimate.input_torque, state.input_torque),
        Pair("Input speed, measured", "rad/s", estimate.input_speed, state.input_speed),
        Pair("Power loss, measured", "W", loss, state.power_loss),
    ]


def beside_rows(
    estimate: FollowerEstimate, state: GearboxState, events: Iterable[FollowerEvent]
) -> Iterator[tuple[str, str, str, str]]:
    """Yield title, value, unit and remark: simulated value and residual, then changes."""
    for pair in pairs(estimate, state):
        beside = f"twin {pair.simulated:.5g}, residual {pair.residual:+.3g}"
        known = math.isfinite(pair.measured)
        yield pair.title, _shown(pair.measured), pair.unit, beside if known else ""
    span = f"{estimate.friction_level_low:.3g} to {estimate.friction_level_high:.3g}"
    level = estimate.friction_level
    remark = span if math.isfinite(level) else estimate.friction_level_status.replace("_", " ")
    yield "Friction level", _shown(level), "", remark
    for event in events:
        yield "Change", "", "", f"{event.what}: {event.evidence}"


def _shown(value: float) -> str:
    return f"{value:.5g}" if math.isfinite(value) else "-"


class Monitor(Remote):
    """Subscribes to a twin in `namespace` and keeps the recent history of its quantities."""

    def __init__(self, namespace: str) -> None:
        super().__init__(namespace)
        self.state: GearboxState | None = None
        self.axes: AxesState | None = None
        self.report: dict[str, str] = {}
        self.estimate: FollowerEstimate | None = None
        self.events: dict[int, FollowerEvent] = {}
        self._histories = {
            figure.field: deque[float](maxlen=_HISTORY) for figure in (*FIGURES, *OF_AXES)
        }
        self.keep("state", GearboxState, "gearbox_state")
        self.keep("axes", AxesState, AXES_STATE)
        self.keep("estimate", FollowerEstimate, "follower/estimate")
        self.node.create_subscription(DiagnosticArray, "/diagnostics", self._on_diagnostics, 10)
        self.node.create_subscription(FollowerEvent, "follower/event", self._on_event, LATCHED)

    def table(self, width: int) -> Table:
        """
        Return the present table, at most `width` characters wide.

        Raises `ConnectionError` if no state has been received.
        """
        state = self.state
        if state is None:
            raise ConnectionError(
                f"no twin publishes in {self.namespace}: start one with `planetary-twin run`"
            )
        shown_history = max(width - _BESIDE_HISTORY, 1)
        table = Table(box=None, header_style="bold", pad_edge=False)
        table.add_column(f"{self.namespace}  {state.simulated_time:.2f} s")
        table.add_column("value", justify="right")
        table.add_column("")
        table.add_column("history")
        rows: list[tuple[Figure, GearboxState | AxesState]] = [(each, state) for each in FIGURES]
        if self.axes is not None:
            rows += [(each, self.axes) for each in OF_AXES]
        for figure, message in rows:
            value, history = figure.value(message), self._histories[figure.field]
            history.append(value)
            shown = "-" if math.isnan(value) else f"{value:.5g}"
            table.add_row(
                figure.title,
                shown,
                figure.quantity.unit,
                sparkline(list(history)[-shown_history:]),
            )
        if self.estimate is not None:
            table.add_section()
            for row in beside_rows(self.estimate, state, self.events.values()):
                table.add_row(*row)
        table.add_section()
        for name, key, unit in _REPORTED:
            table.add_row(name, self.report.get(key, "-"), unit, "")
        return table

    def _on_event(self, message: FollowerEvent) -> None:
        self.events[message.number] = message

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
        with Live(monitor.table(console.width), console=console, refresh_per_second=8) as live:
            while time.monotonic() < end:
                time.sleep(_LIVE_PERIOD)
                live.update(monitor.table(console.width))


def _print(monitor: Monitor, console: Console, end: float) -> None:
    """Print a table once a second, for a file or a pipe."""
    console.print(monitor.table(console.width))
    while time.monotonic() + _PLAIN_PERIOD < end:
        time.sleep(_PLAIN_PERIOD)
        console.print(monitor.table(console.width))
