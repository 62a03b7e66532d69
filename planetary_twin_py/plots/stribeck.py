"""Stribeck curve of the meshes: boundary and viscous friction against lambda ratio."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from ..units.catalogue import SIDES, side_title
from .clipped import clipped_points, mark
from .quantity import Column, find
from .style import BLUE, GREEN, ORANGE, logarithmic, panels

PARTS = (("boundary", ORANGE, "--"), ("viscous", GREEN, "--"))


def stribeck_diagram(known: dict[str, Column]) -> Figure:
    """Draw friction coefficients of sun and ring meshes against their mean lambda ratio.

    The coefficient is mean friction/mean mesh force.

    Raises:
        ValueError: a column is missing, or the lambda ratio does not vary.
    """
    figure, panes = panels(len(SIDES), 3.2)
    for axes, side in zip(panes, SIDES, strict=True):
        ratio = find(known, f"{side}_lambda_ratio", "x").values
        force = np.abs(find(known, f"{side}_mesh_force_mean", "y").values)
        if not np.ptp(ratio) > 0.0:
            raise ValueError(
                f"{side}_lambda_ratio: does not vary; vary the speed, with "
                "lubrication.lambda_ratio = computed"
            )
        order = np.argsort(ratio)
        total = np.zeros(len(ratio))
        for part, colour, dash in PARTS:
            friction = find(known, f"{side}_{part}_friction", "y").values / force
            total += friction
            axes.plot(ratio[order], friction[order], dash, color=colour, label=part)
        axes.plot(ratio[order], total[order], color=BLUE, label="total", zorder=1.9)
        hollow = clipped_points(known, len(ratio), [side])
        mark(axes, ratio[hollow], total[hollow], BLUE)
        logarithmic(axes, "x")
        axes.set_title(f"{side_title(side)} meshes")
        axes.set_xlabel("Lambda ratio [-]")
        axes.set_ylabel("Friction coefficient [-]")
    top = max(axes.get_ylim()[1] for axes in panes)
    for axes in panes:
        axes.set_ylim(0.0, top)
    figure.legend(*panes[0].get_legend_handles_labels(), loc="outside lower center", ncols=3)
    return figure
