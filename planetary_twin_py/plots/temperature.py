"""Steady temperatures of the oil over load and speed."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ..scene import Scene
from ..studies.temperature import AtPoint
from ..units.catalogue import RPM
from .style import BLUE, ORANGE, applied, panels

ZERO = 273.15  # [K] at 0 degC


def temperature_diagram(scene: Scene, found: Sequence[AtPoint]) -> Figure:
    """Draw the steady temperatures of the oil: a map, or all states over one quantity.

    Args:
        scene: gives the title.
        found: states at the pairs of torques and speeds.
    """
    torques, speeds = (np.unique([point[n] for point in found]) for n in (0, 1))
    with applied():
        figure, (axes,) = panels(height=4.0)
        if len(torques) > 1 and len(speeds) > 1:
            _draw_map(axes, found, torques, speeds)
        else:
            _draw_states(axes, found, over_torque=len(torques) > 1)
        axes.set_title(f"{scene.name}: steady temperature of the oil")
    return figure


def _draw_map(
    axes: Axes, found: Sequence[AtPoint], torques: np.ndarray, speeds: np.ndarray
) -> None:
    """The coldest stable state as contours; without one a hole."""
    values = np.full((len(torques), len(speeds)), np.nan)
    for torque, speed, states in found:
        stable = [state.temperatures["oil"] for state in states if state.stable]
        if stable:
            place = np.searchsorted(torques, torque), np.searchsorted(speeds, speed)
            values[place] = min(stable) - ZERO
    filled = axes.contourf(speeds * RPM, torques, np.ma.masked_invalid(values), levels=12)
    axes.figure.colorbar(filled, ax=axes, label="Oil, coldest stable state [°C]")
    axes.set(xlabel="Speed of the motor [rpm]", ylabel="Torque of the motor [N m]")


def _draw_states(axes: Axes, found: Sequence[AtPoint], over_torque: bool) -> None:
    """All states over the torque or the speed, unstable ones apart."""
    for stable, colour, marker in ((True, BLUE, "o"), (False, ORANGE, "x")):
        rows = [
            (point.input_torque if over_torque else point.input_speed * RPM, state)
            for point in found
            for state in point.states
            if state.stable == stable
        ]
        at = [place for place, _ in rows]
        oil = [state.temperatures["oil"] - ZERO for _, state in rows]
        label = "stable" if stable else "unstable"
        axes.plot(at, oil, linestyle="", marker=marker, color=colour, label=label)
    name = "Torque of the motor [N m]" if over_torque else "Speed of the motor [rpm]"
    axes.set(xlabel=name, ylabel="Oil [°C]")
    axes.legend()
