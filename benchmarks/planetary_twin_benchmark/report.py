"""The figures of the benchmark, for a terminal and as a page of the documentation."""

from __future__ import annotations

import math
from collections.abc import Sequence
from string import Template

from rich.table import Table

from .machine import machine
from .reference import RELATIVE
from .table import METHODS, Row
from .timing import METHOD

_TITLES = (
    "case", "method", "tolerance", "DTE error", "error/tolerance", "loss error", "speed", "spread",
    "sampled", "end to end",
)  # fmt: skip

_PAGE = Template("""# Speed against error

Written by the command in `benchmarks/README.md` on one core of a shared machine
($machine), so compare ratios.
`benchmarks/speed_and_error.json` has the figures of every case, method and tolerance.

- *speed*: simulated time over processor time.
- *DTE error*: rms error of the dynamic transmission error over its rms, for the worst mesh.
- *loss error*: relative error of the mean power loss.
- Reference: SciPy's DOP853 from event to event, relative tolerance $relative. It shares the
  equations with the integrator, but no step, step control, interpolant or event location.
  `tests/reference_model.py` is a second reference, which shares no code with the model.
$peers
The method `march` is exponential collocation at Radau points in the modes of the meshes in contact,
from event to event. Near standstill ROS34PW2, a linearly implicit Runge-Kutta method of order 3,
takes over (`core/integrators/`). `tolerance` bounds the local error of a step relative to the
static deflection of the meshes; in these cases the DTE error is $least to $most times the
tolerance. The default method, `auto`, does the same until steady running is periodic, see below.
$picture$summary""")

_PEERS = f"""- Methods other than {" and ".join(f"`{name}`" for name in METHODS)} are off-the-shelf
  solvers and fixed steps, see `benchmarks/planetary_twin_benchmark/peers/`. They take the same
  equations as one compiled function of time and state, without information about events. They
  interpolate the samples; their time includes the computation of transmission errors and losses
  from the states. Without samples they return a state each millisecond.
"""


def _cells(row: Row) -> tuple[str, ...]:
    return (
        row.case,
        row.method,
        f"{row.tolerance:.0e}",
        _figure(row.error_dte, ".1e"),
        _figure(row.error_ratio, ".2g"),
        _figure(row.error_power_loss, ".1e"),
        row.note or f"{row.rtf:.3g}",
        "" if row.note else f"{row.rtf_low:.3g}-{row.rtf_high:.3g}",
        _figure(row.rtf_sampled, ".3g"),
        _figure(row.end_to_end_rtf, ".3g"),
    )


def _figure(value: float, form: str) -> str:
    return "-" if math.isnan(value) else format(value, form)


def as_table(rows: Sequence[Row]) -> Table:
    """Table for the terminal."""
    table = Table(box=None, header_style="bold", pad_edge=False)
    for title in _TITLES:
        name = title in _TITLES[:2]
        narrow = title.replace(" ", "\n").replace("/", "/\n")
        table.add_column(narrow, justify="left" if name else "right", no_wrap=not name)
    for row in rows:
        table.add_row(*_cells(row))
    return table


def as_markdown(rows: Sequence[Row], picture: str | None = None, summary: str = "") -> str:
    """The page `docs/speed-and-accuracy.md`.

    Args:
        rows: the runs.
        picture: link to a picture of the same rows.
        summary: section about the same rows.
    """
    ratios = [row.error_ratio for row in rows if row.method == METHOD]
    return _PAGE.substitute(
        least=f"{min(ratios):.1f}",
        most=f"{max(ratios):.1f}",
        relative=f"{RELATIVE:g}",
        machine=machine(),
        peers=_PEERS if any(row.method not in METHODS for row in rows) else "",
        summary=summary,
        picture="" if picture is None else f"\n![Error against time]({picture})\n",
    )
