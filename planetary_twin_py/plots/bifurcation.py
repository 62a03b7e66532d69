"""Bifurcation diagram: Poincare sections of the steady motions against speed."""

from __future__ import annotations

from collections.abc import Sequence

from matplotlib.figure import Figure

from ..studies.bifurcation import DOWN, UP
from .quantity import Column
from .style import BLUE, ORANGE, panels

# The larger dots of rising speed are drawn first, so that they show around common dots.
BRANCHES = ((UP, "rising speed", BLUE, 2.6), (DOWN, "falling speed", ORANGE, 1.1))


def bifurcation_diagram(known: dict[str, Column], meshes: Sequence[str] = ()) -> Figure:
    """Draw a dot for each sampled mesh cycle.

    Args:
        known: columns of the table by name.
        meshes: columns to draw, a panel each; if empty, the first mesh.
    """
    first = next(name for name in known if name.endswith("_dte"))
    shown = tuple(meshes) or (first,)
    figure, panes = panels(len(shown), 4.2 if len(shown) == 1 else 2.9, 1)
    speed, direction = known["input_speed"], known["direction"].values
    for axes, name in zip(panes, shown, strict=True):
        for branch, label, colour, size in BRANCHES:
            selected = direction == branch
            axes.plot(
                speed.values[selected],
                known[name].values[selected],
                "o",
                color=colour,
                markersize=size,
                markeredgewidth=0.0,
                label=label,
                rasterized=True,  # tens of thousands of dots
            )
        axes.set_xlabel("Speed [rpm]")
        axes.set_ylabel(known[name].label)
        axes.margins(x=0.01)
    figure.legend(
        *panes[0].get_legend_handles_labels(), loc="outside upper right", ncols=2, markerscale=2.5
    )
    return figure
