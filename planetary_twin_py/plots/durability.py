"""Load duration and load revolution distributions of a duty."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from ..lifetime.duty_result import DutyLife
from ..scene import Scene
from .style import BLUE, GREY, ORANGE, applied, panels, remark

HOUR = 3600.0  # [s]
KILO = 1e4  # [N m] from which torque is drawn in kN m


def load_diagram(scene: Scene, found: DutyLife) -> Figure:
    """Draw the time and the turns at each torque, and the equivalent torque.

    Args:
        scene: gives the title.
        found: the damage of a duty.
    """
    loads, same = found.loads, found.equivalent
    scale, unit = (1e-3, "kN m") if np.abs(loads.edges).max() >= KILO else (1.0, "N m")
    with applied():
        figure, axes = panels(2, height=3.2)
        for place, values, colour, label, name in (
            (axes[0], loads.duration / HOUR, BLUE, "Time [h]", "load duration (LDD)"),
            (axes[1], loads.turns, ORANGE, "Turns of the input", "load revolution (LRD)"),
        ):
            place.stairs(values, scale * loads.edges, fill=True, color=colour)
            place.set_yscale("log")
            place.set_ylim(bottom=0.5 * float(values[values > 0.0].min()))
            place.set_xlabel(f"Input torque [{unit}]")
            place.set_ylabel(label)
            place.set_title(name)
            if same.part:
                place.axvline(scale * same.torque, color=GREY, linewidth=0.8)
        figure.suptitle(scene.name, x=0.01, ha="left")
        if same.part:
            remark(figure, f"line: equivalent torque of {same.part}, m = {same.exponent:.3g}")
    return figure
