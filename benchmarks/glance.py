"""Draws speed against error from the last measurement with peers.

python benchmarks/glance.py docs/speed-against-error.png
"""

from __future__ import annotations

import json
import math
import sys
from pathlib import Path

from matplotlib.figure import Figure
from planetary_twin_benchmark.table import Row

from planetary_twin_py.plots.style import applied, colour_of, panels, save

MEASURED = Path(__file__).with_name("speed_and_error.json")
CASES = {
    "steady 1000 rpm": "steady, 1000 rpm",
    "rattle": "light load: teeth rattle",
    "stiff 100 rpm": "stiff, 100 rpm",
}
METHODS = {
    "march": "planetary_twin",
    "cvode_bdf_compiled": "SUNDIALS CVODE, BDF",
    "cvode_adams_compiled": "SUNDIALS CVODE, Adams",
    "lsoda_compiled": "LSODA",
    "dop853_compiled": "DOP853",
    "rk4": "RK4, fixed steps",
}
BEST, WORST = 1e-7, 1.0  # relative errors in the plot
FAST = (0.1, 100.0)  # times real time


def rows() -> list[Row]:
    """The measured rows, with NaN for the null of JSON."""
    found = json.loads(MEASURED.read_text("utf-8"))
    known = [entry for entry in found if set(entry) == set(Row._fields)]
    return [
        Row(**{name: math.nan if value is None else value for name, value in entry.items()})
        for entry in known
    ]


def figure(measured: list[Row]) -> Figure:
    """A panel for each case, a line for each method: right and down is better."""
    with applied():
        drawn, panes = panels(len(CASES), 2.9)
        for axes, (case, title) in zip(panes, CASES.items(), strict=True):
            for method, label in METHODS.items():
                own = [r for r in measured if (r.case, r.method) == (case, method)]
                own = sorted((r for r in own if r.error_dte < WORST), key=lambda r: r.error_dte)
                axes.loglog(
                    [r.rtf_sampled for r in own],
                    [r.error_dte for r in own],
                    marker="o",
                    color=colour_of(list(METHODS), method),
                    lw=2.2 if method == "march" else 1.0,
                    zorder=3 if method == "march" else 2,
                    label=label,
                )
            axes.axvline(1.0, color="0.8", lw=0.8, zorder=1)
            axes.set(title=title, xlim=(FAST[0], FAST[1]), ylim=(BEST, WORST))
            axes.minorticks_off()
        panes[0].set_ylabel("relative error of the DTE")
        drawn.supxlabel("simulated seconds per second on one core, samples at 50 kHz included")
        handles, labels = panes[0].get_legend_handles_labels()
        drawn.legend(handles, labels, loc="outside upper center", ncols=len(METHODS) // 2)
    return drawn


if __name__ == "__main__":
    save(figure(rows()), sys.argv[1])
