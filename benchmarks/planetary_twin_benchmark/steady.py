"""Speed and error of steady running once mesh cycles repeat."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from typing import NamedTuple

import numpy as np
from rich.table import Table

from planetary_twin_py._core import DTE
from planetary_twin_py.run.engine import Engine
from planetary_twin_py.scene import Scene

from .cases import Case
from .markdown import markdown_table, speed_cell
from .samples import samples_until
from .table import TOLERANCES, errors
from .timing import METHOD, Speed, affordable, run, speed

AUTO = "auto"
MINUTE = 60.0  # [s]
BY = 4.0  # [s] by which it must repeat
COMPARED = 0.02  # [s] before BY that are compared with a computed run ...
EXACT = 1e-7  # ... at this tolerance ...
RESOLVED = 1e6  # [Hz] ... with samples that resolve every cycle, since a delay shifts them
SHOWN = 1e-3  # tolerance on the page; the JSON file has all
LOOKED = 0.01  # [s] between two checks whether it repeats
NAN = math.nan
NOT = Speed(NAN, NAN, NAN)


class Steady(NamedTuple):
    """A minute of one case."""

    case: str
    tolerance: float
    repeats_from: float  # [s], NaN if it does not repeat
    late: float  # delay [mesh cycles]
    error_dte: float  # without the delay
    error_power_loss: float
    speed: Speed  # of a minute from the start, without samples
    setup_s: float  # building and starting the model [s]
    computed_error_dte: float = NAN  # without the delay, if every cycle is computed
    computed: Speed = NOT  # then, from the start, without samples

    def figures(self) -> dict[str, str | float | None]:
        """Values for JSON, None for NaN."""
        values = {"method": AUTO, **self._asdict()}
        for name, prefix in (("speed", ""), ("computed", "computed_")):
            ends = (f"{prefix}{end}" for end in ("rtf", "rtf_low", "rtf_high"))
            values.update(zip(ends, values.pop(name), strict=True))
        return {name: None if value != value else value for name, value in values.items()}


def measure_steady(
    cases: Iterable[Case],
    tolerances: Iterable[float] = TOLERANCES,
    progress: Callable[[str], None] = lambda text: None,
) -> list[Steady]:
    """Measure all cases; a case that does not repeat has no figures."""
    found, tolerances = [], list(tolerances)
    for case in cases:
        exact = None
        for tolerance in tolerances:
            progress(f"{case.name}: a minute, tolerance {tolerance:g}")
            scene = case.scene()
            begin = repeats_from(scene, tolerance)
            if math.isnan(begin):
                found.append(Steady(case.name, tolerance, begin, NAN, NAN, NAN, NOT, NAN))
                continue
            exact = _settled(scene, EXACT, METHOD) if exact is None else exact
            error = _errors(_settled(scene, tolerance, AUTO), exact)
            timed = speed(scene, MINUTE, AUTO, tolerance, sampled=False)
            setup = run(scene, LOOKED, AUTO, tolerance, sampled=False).setup_s
            _, computed_error, _ = _errors(_settled(scene, tolerance, METHOD), exact)
            span = affordable(scene, tolerance, case.duration, BY)
            computed = speed(scene, span, METHOD, tolerance, sampled=False)
            found.append(
                Steady(
                    case.name, tolerance, begin, *error, timed, setup, computed_error, computed
                )
            )  # fmt: skip
    return found


def repeats_from(scene: Scene, tolerance: float) -> float:
    """Simulated time [s] from which mesh cycles repeat; NaN if they do not by BY."""
    engine = Engine(scene, tolerance)
    for look in range(1, round(BY / LOOKED) + 1):
        engine.sample(look * LOOKED)
        if engine.repeats:
            return look * LOOKED
    return math.nan


class _Settled(NamedTuple):
    """The interval that is compared."""

    mesh: np.ndarray  # (samples, QUANTITIES, meshes)
    cycles: np.ndarray  # (samples,) completed by the meshes


def _settled(scene: Scene, tolerance: float, method: str) -> _Settled:
    first = round((BY - COMPARED) * RESOLVED) + 1
    room = round(COMPARED * RESOLVED)
    engine = Engine(scene, tolerance, method)
    samples, train = samples_until(engine, BY, first, RESOLVED, room), engine.train
    motor = train.coupling.ends[0, 0]
    turns = samples.turns[:, 0] + samples.angle[:, motor] / (2.0 * math.pi)
    return _Settled(samples.mesh, turns * float(train.cycle.per_turn[0]))


def _errors(found: _Settled, exact: _Settled) -> tuple[float, float, float]:
    """Delay [mesh cycles], and the errors that the delay does not explain.

    The speed loop compensates an error of friction by an angle. It is soft, so the relative error
    of this angle is many times that of the loss.
    """
    late = float((exact.cycles - found.cycles).mean())
    pace = np.gradient(exact.cycles)[:, None]
    shifted = found.mesh.copy()
    shifted[:, DTE] += late * np.gradient(exact.mesh[:, DTE], axis=0) / pace
    return late, *errors(shifted, exact.mesh)


_TITLES = (
    "case", "tolerance", "repeats from", "late by", "DTE error", "error/tolerance", "loss error",
    "a minute", "spread",
)  # fmt: skip


def _cells(row: Steady) -> tuple[str, ...]:
    if math.isnan(row.repeats_from):
        return row.case, f"{row.tolerance:.0e}", "never", *["-"] * 6
    median, low, high = row.speed
    loss = row.error_power_loss
    return (
        row.case,
        f"{row.tolerance:.0e}",
        f"{row.repeats_from:.2f} s",
        f"{row.late:.0e}",
        f"{row.error_dte:.1e}",
        f"{row.error_dte / row.tolerance:.2g}",
        "-" if math.isnan(loss) else f"{loss:.1e}",
        f"{median:.3g}",
        f"{low:.3g}-{high:.3g}",
    )


_PAGE_TITLES = (
    "case", "repeats from", "late by", "DTE error", "loss error", "a minute", "every cycle",
    "its DTE error",
)  # fmt: skip


def _page_cells(row: Steady) -> tuple[str, ...]:
    case, _, begin, late, dte, _, loss, *_ = _cells(row)
    if math.isnan(row.repeats_from):
        return case, begin, *["-"] * 6
    computed = speed_cell(row.computed), f"{row.computed_error_dte:.1e}"
    return case, begin, late, dte, loss, speed_cell(row.speed), *computed


def steady_table(rows: Sequence[Steady]) -> Table:
    """Table for the terminal."""
    table = Table(box=None, header_style="bold", pad_edge=False)
    for title in _TITLES:
        table.add_column(title, justify="left" if title == "case" else "right")
    for row in rows:
        table.add_row(*_cells(row))
    return table


def steady_markdown(rows: Sequence[Steady]) -> str:
    """A section for the page `docs/speed-and-accuracy.md`."""
    return f"""
## Steady running

The default method, `auto`, at tolerance {SHOWN:.0e} over {MINUTE:g} s in the same cases, and
in some whose axes move. Once mesh cycles are periodic and the motion is stable, they are repeated
instead of computed (`core/integrators/periodic.hpp`). The JSON file has more tolerances.

- *every cycle*: simulated time over processor time of method `{METHOD}`, which computes every
  cycle, without samples.
- *repeats from*: simulated time from which cycles are repeated.
- *a minute*: simulated time over processor time from the start, without samples, with settling; in
  brackets the slowest and the fastest round.
- Errors are those of the last {COMPARED * 1e3:g} ms before {BY:g} s, against `{METHOD}` at
  tolerance {EXACT:g}.
- *late by*: delay in mesh cycles. The speed loop compensates an error of the friction by an angle;
  its bandwidth of 3 Hz is so low that a loss error of 1e-6 gives a delay of 3e-6 of a cycle.
- *DTE error*: without this delay.

{markdown_table(_PAGE_TITLES, [_page_cells(row) for row in rows if row.tolerance == SHOWN])}
"""
