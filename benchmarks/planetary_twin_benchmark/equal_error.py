"""Speed at equal error: the fastest run of each kind of solver within an error."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence

from .markdown import markdown_table, three_digits
from .steady import Steady
from .table import Row
from .timing import METHOD, SAMPLE_RATE

ERROR = 1e-3  # of the DTE
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
    names = dict.fromkeys(row.case for row in rows)
    cases = {name: [row for row in rows if row.case == name] for name in names}
    cells = [(name, *_speeds(own), _minute(name, steady)) for name, own in cases.items()]
    return f"""
## At equal error

Speed of the fastest run with a DTE error of at most {ERROR:.0e}, without samples; in brackets the
ratio of `{METHOD}` to it. *sampled*: with samples at {SAMPLE_RATE / 1e3:g} kHz, `{METHOD}` and
CVODE. A sample of `{METHOD}` has all quantities of the meshes, one of CVODE transmission errors and
power loss. *`auto`, 60 s*: one minute of the default method as in
[steady running](#steady-running), without samples.

{markdown_table(("case", f"`{METHOD}`", *KINDS, "sampled", "CVODE", "`auto`, 60 s"), cells)}
"""


def _speeds(rows: Sequence[Row]) -> list[str]:
    """Cells without samples of all kinds of solvers, then with samples of CVODE."""
    return [
        *_of_kinds(rows, without_samples, KINDS.values()),
        *_of_kinds(rows, with_samples, [KINDS["CVODE"]]),
    ]


def _of_kinds(rows: Sequence[Row], speed: SpeedOf, kinds: Iterable[tuple[str, ...]]) -> list[str]:
    """The speed of the own method, and those of others with the ratio to them."""
    own = fastest(rows, ERROR, (METHOD,), speed)
    cells = [_figure(own)]
    for beginnings in kinds:
        peer = fastest(rows, ERROR, beginnings, speed)
        cells.append(
            _figure(peer)
            if math.isnan(own / peer)
            else f"{peer:.2g} ({float(f'{own / peer:.2g}'):g})"
        )
    return cells


def _minute(case: str, steady: Sequence[Steady]) -> str:
    speeds = [row.speed.median for row in steady if row.case == case and row.error_dte <= ERROR]
    return _figure(max(speeds, default=math.nan))


def _figure(speed: float) -> str:
    return "-" if math.isnan(speed) else three_digits(speed)
