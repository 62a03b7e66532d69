"""Speed at equal error: the fastest run of each kind of solver within an error."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence

from .markdown import markdown_table, three_digits
from .steady import Steady
from .table import Row
from .timing import METHOD, SAMPLE_RATE

ERRORS = (1e-3, 1e-6)
# Off-the-shelf solvers, by the first letters of their names.
KINDS = {
    "CVODE": ("cvode",),
    "SciPy": ("scipy",),
    "others": ("lsoda", "radau", "bdf", "dop", "tsit"),
}


SpeedOf = Callable[[Row], float]


def with_samples(row: Row) -> float:
    """Simulated time over processor time, with samples."""
    return row.rtf_sampled


def without_samples(row: Row) -> float:
    """The same without samples."""
    return row.rtf


def fastest(
    rows: Iterable[Row], error: float, beginnings: tuple[str, ...], speed: SpeedOf = with_samples
) -> float:
    """The highest speed; NaN if no run is accurate enough."""
    speeds = [
        speed(row)
        for row in rows
        if row.method.startswith(beginnings) and row.error_dte <= error and not row.note
    ]
    return max(speeds, default=math.nan)


def equal_error_markdown(rows: Sequence[Row], steady: Sequence[Steady]) -> str:
    """A section for the page `docs/speed-and-accuracy.md`; nothing without peers."""
    if all(row.method in (METHOD, "rosenbrock") for row in rows):
        return ""
    body = "\n\n".join(_section(error, rows, steady) for error in ERRORS)
    return f"""
## At equal error

Speed of the fastest run within an error of the DTE; in brackets the ratio of `{METHOD}` to it. A
sample of `{METHOD}` has all quantities of the meshes, one of the others transmission errors and
power loss. *`auto`, 60 s*: one minute of the default method as in
[steady running](#steady-running), without samples.

{body}
"""


def _section(error: float, rows: Sequence[Row], steady: Sequence[Steady]) -> str:
    """The speeds of all cases at one error."""
    names = dict.fromkeys(row.case for row in rows)
    cases = {name: [row for row in rows if row.case == name] for name in names}
    bare = [
        (name, *_speeds(own, error, without_samples), _minute(name, error, steady))
        for name, own in cases.items()
    ]
    sampled = [(name, *_speeds(own, error, with_samples)) for name, own in cases.items()]
    titles = ("case", f"`{METHOD}`", *KINDS)
    return f"""### DTE error at most {error:.0e}

Without samples:

{markdown_table((*titles, "`auto`, 60 s"), bare)}

With samples at {SAMPLE_RATE / 1e3:g} kHz:

{markdown_table(titles, sampled)}"""


def _speeds(rows: Sequence[Row], error: float, speed: SpeedOf) -> list[str]:
    own = fastest(rows, error, (METHOD,), speed)
    cells = [_figure(own)]
    for beginnings in KINDS.values():
        peer = fastest(rows, error, beginnings, speed)
        cells.append(
            _figure(peer)
            if math.isnan(own / peer)
            else f"{peer:.2g} ({float(f'{own / peer:.2g}'):g})"
        )
    return cells


def _minute(case: str, error: float, steady: Sequence[Steady]) -> str:
    speeds = [row.speed.median for row in steady if row.case == case and row.error_dte <= error]
    return _figure(max(speeds, default=math.nan))


def _figure(speed: float) -> str:
    return "-" if math.isnan(speed) else three_digits(speed)
