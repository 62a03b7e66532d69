"""The table of the benchmark, for a terminal and for the documentation."""

from __future__ import annotations

import math
from collections.abc import Sequence
from statistics import median
from string import Template

from rich.table import Table

from .cases import CASES
from .reference import RELATIVE
from .table import METHOD, ROUNDS, SAMPLE_RATE, Row

_TITLES = ("case", "method", "tolerance", "DTE error", "loss error", "speed", "spread")

_PAGE = Template("""# Speed against error

Made by `make bench ARGS="--markdown docs/speed-and-accuracy.md"`: one core of a shared machine, so
read ratios. Kernels are compiled and cached before; scene, arrays and start take $setup ms more.

- *speed*: simulated over processor time with samples of all meshes at $rate kHz, median of
  $rounds rounds, beside it the slowest and the fastest.
- *DTE error*: rms error of the dynamic transmission error over its rms, the worst mesh.
- *loss error*: error of the mean power loss.
- Reference: SciPy's DOP853 from event to event, relative tolerance $relative. It shares the
  equations with the integrator, but no step, step control, interpolant or event location.
  `tests/reference_model.py` is a second one that shares no code with the model at all.
$peers
The method is exponential collocation at three Radau points in the modes of the meshes in contact,
from event to event; near standstill ROS34PW2, a linearly implicit Runge-Kutta method of order 3,
takes over (`integrators/`). `tolerance` bounds the local error of a step relative to the static
deflection of the meshes; in these cases the DTE error comes out at $least to $most times the
tolerance.

$table

The cases: the scene `paper` with
$cases
""")

_PEERS = f"""- Methods other than `{METHOD}` are off-the-shelf solvers and fixed steps, see
  `benchmark/peers/`. They take the same equations as one compiled function of time and state, and
  are not told of events. Their time leaves out working losses out of the states.
"""


def _cells(row: Row) -> tuple[str, ...]:
    return (
        row.case,
        row.method,
        f"{row.tolerance:.0e}",
        _figure(row.error_dte, ".1e"),
        _figure(row.error_power_loss, ".1e"),
        row.note or f"{row.rtf:.3g}",
        "" if row.note else f"{row.rtf_low:.3g}-{row.rtf_high:.3g}",
    )


def _figure(value: float, form: str) -> str:
    return "-" if math.isnan(value) else format(value, form)


def as_table(rows: Sequence[Row]) -> Table:
    """For the terminal."""
    table = Table(box=None, header_style="bold", pad_edge=False)
    for title in _TITLES:
        name = title in _TITLES[:2]
        table.add_column(title, justify="left" if name else "right", no_wrap=not name)
    for row in rows:
        table.add_row(*_cells(row))
    return table


def as_markdown(rows: Sequence[Row]) -> str:
    """The page `docs/speed-and-accuracy.md`."""
    lines = [_TITLES, ("---",) * len(_TITLES), *(_cells(row) for row in rows)]
    own = [row for row in rows if row.method == METHOD]
    ratios = [row.error_dte / row.tolerance for row in own]
    return _PAGE.substitute(
        least=f"{min(ratios):.1f}",
        most=f"{max(ratios):.1f}",
        setup=f"{median(row.setup_s for row in own) * 1e3:.0f}",
        rate=f"{SAMPLE_RATE / 1e3:g}",
        rounds=ROUNDS,
        relative=f"{RELATIVE:g}",
        peers="" if len(own) == len(rows) else _PEERS,
        table="\n".join("| " + " | ".join(cells) + " |" for cells in lines),
        cases="\n".join(f"- {case.name}: {case.changes or 'as it is'}" for case in CASES),
    )
