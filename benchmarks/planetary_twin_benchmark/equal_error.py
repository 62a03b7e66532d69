"""Who is fastest at an error: the quickest run of each kind whose error is no larger."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence

from .steady import Steady
from .table import Row
from .timing import METHOD

ERRORS = (1e-3, 1e-4, 1e-6)
# Solvers off the shelf, by the beginnings of their names.
KINDS = {
    "CVODE": ("cvode",),
    "SciPy": ("scipy",),
    "others": ("lsoda", "radau", "bdf", "dop", "tsit"),
}


def fastest(rows: Iterable[Row], error: float, beginnings: tuple[str, ...]) -> float:
    """Simulated over processor time, samples included; NaN where no run is so exact."""
    speeds = [
        row.rtf_sampled
        for row in rows
        if row.method.startswith(beginnings) and row.error_dte <= error and not row.note
    ]
    return max(speeds, default=math.nan)


def equal_error_markdown(rows: Sequence[Row], steady: Sequence[Steady]) -> str:
    """A section for the page `docs/speed-and-accuracy.md`; nothing without peers."""
    if all(row.method in (METHOD, "rosenbrock") for row in rows):
        return ""
    titles = ("case", "DTE error at most", f"`{METHOD}`", *KINDS, "a minute of `auto`")
    lines: list[Sequence[str]] = [titles, ("---",) * len(titles)]
    for case in dict.fromkeys(row.case for row in rows):
        own = [row for row in rows if row.case == case]
        for error in ERRORS:
            lines.append((case, f"{error:.0e}", *_speeds(own, error), _minute(case, error, steady)))
    body = "\n".join("| " + " | ".join(cells) + " |" for cells in lines)
    return f"""
## At equal error

Speed of the fastest run within this error, with samples; in brackets the ratio of `{METHOD}` to it.
*a minute*: as below, without samples.

{body}
"""


def _speeds(rows: Sequence[Row], error: float) -> list[str]:
    own = fastest(rows, error, (METHOD,))
    cells = [_figure(own)]
    for beginnings in KINDS.values():
        peer = fastest(rows, error, beginnings)
        cells.append(_figure(peer) if math.isnan(own / peer) else f"{peer:.2g} ({own / peer:.2g})")
    return cells


def _minute(case: str, error: float, steady: Sequence[Steady]) -> str:
    speeds = [row.speed.median for row in steady if row.case == case and row.error_dte <= error]
    return _figure(max(speeds, default=math.nan))


def _figure(speed: float) -> str:
    return "-" if math.isnan(speed) else f"{speed:.3g}"
