"""Load duration and load revolution distributions of a duty."""

from __future__ import annotations

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ..lifetime.duty_life import DutyLife
from ..scene import Scene
from .style import BLUE, GREY, ORANGE, applied, panels

HOUR = 3600.0  # [s]


def load_diagram(scene: Scene, found: DutyLife) -> Figure:
    """Draw the time and the turns at each torque, and the equivalent torque.

    Args:
        scene: gives the title.
        found: the damage of a duty.

    Returns:
        The figure.
    """
    loads = found.loads
    with applied():
        figure, axes = panels(2, height=3.2)
        for place, values, colour, label in (
            (axes[0], loads.duration / HOUR, BLUE, "Time [h]"),
            (axes[1], loads.turns, ORANGE, "Turns of the input"),
        ):
            place.stairs(values, loads.edges, fill=True, color=colour)
            place.set_yscale("log")
            if values.any():
                place.set_ylim(bottom=0.5 * float(values[values > 0.0].min()))
            place.set_xlabel("Input torque [N m]")
            place.set_ylabel(label)
        axes[0].set_title(f"{scene.name}: load duration distribution (LDD)")
        axes[1].set_title("load revolution distribution (LRD)")
        if found.equivalent.part:
            _mark(axes[1], found)
    return figure


def _mark(axes: Axes, found: DutyLife) -> None:
    torque = found.equivalent.torque
    axes.axvline(torque, color=GREY, linewidth=0.8)
    text = f"equivalent for {found.equivalent.part}, m = {found.equivalent.exponent:.3g}"
    axes.text(torque, 0.97, f" {text}", transform=axes.get_xaxis_transform(), va="top", fontsize=8)
