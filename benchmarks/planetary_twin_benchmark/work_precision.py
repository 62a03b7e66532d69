"""Work-precision diagram: error of every method against its computing time."""

from __future__ import annotations

import math
from collections.abc import Sequence

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import LogLocator

from planetary_twin_py.plots.style import CYCLE, applied, colour_of, panels

from .table import METHODS, Row

COLUMNS = 3
MARKERS = "osv^"  # the next one if a colour repeats
FEWER = 0.8  # line width of general-purpose solvers


def work_precision(rows: Sequence[Row]) -> Figure:
    """Draw a panel for every case in `rows`; rows without results are omitted.

    Times include sampling, because general-purpose solvers have no others.
    """
    measured = [row for row in rows if not row.note]
    cases = list(dict.fromkeys(row.case for row in measured))
    methods = list(dict.fromkeys(row.method for row in measured))
    with applied():
        figure, panes = panels(len(cases), 2.5, COLUMNS)
        for axes, case in zip(panes, cases, strict=True):
            _panel(axes, case, methods, [row for row in measured if row.case == case])
        figure.supxlabel("processor time per simulated second [s]")
        figure.supylabel("relative error of the transmission error")
        lines = {str(line.get_label()): line for axes in panes for line in axes.get_lines()}
        figure.legend(
            handles=list(lines.values()), loc="outside upper center", ncols=min(4, len(lines))
        )
    return figure


def _panel(axes: Axes, case: str, methods: Sequence[str], rows: Sequence[Row]) -> None:
    for n, method in enumerate(methods):
        own = [row for row in rows if row.method == method]
        axes.loglog(
            [1.0 / row.rtf_sampled for row in own],
            [row.error_dte for row in own],
            marker=MARKERS[n // len(CYCLE) % len(MARKERS)],
            color=colour_of(methods, method),
            lw=1.5 if method in METHODS else FEWER,
            label=method,
        )
    axes.set_title(case)
    axes.minorticks_off()  # a short axis has no room for their labels
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_major_locator(LogLocator(numticks=9))
    low, high = axes.get_xlim()
    axes.set_xlim(10.0 ** math.floor(math.log10(low)), 10.0 ** math.ceil(math.log10(high)))
