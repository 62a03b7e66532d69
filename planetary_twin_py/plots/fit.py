"""Pictures of a fit: measured and simulated quantities, and their residuals."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray

from .style import BLUE, GREY, ORANGE, panels

Array = NDArray[np.float64]


def course_figure(
    time: Array, measured: Array, simulated: Array, held_out: Sequence[Array] | None
) -> Figure:
    """Input torque over a manoeuvre, and the residuals.

    Args:
        time: times of the fitted bins [s], (n,).
        measured: [N m], (n,).
        simulated: [N m], (n,).
        held_out: time [s], measured, predicted and half of the interval [N m] of another part,
            (m,) each; None: there is none.
    """
    figure, (above, below) = panels(2, columns=1)
    above.plot(time, measured, ".", color=GREY, label="measured")
    above.plot(time, simulated, color=BLUE, label="simulated")
    below.plot(time, simulated - measured, ".", color=BLUE)
    if held_out is not None:
        other, read, predicted, reach = held_out
        above.plot(other, read, ".", color=GREY)
        above.plot(other, predicted, color=ORANGE, label="predicted")
        below.plot(other, predicted - read, ".", color=ORANGE)
        below.fill_between(other, -reach, reach, color=ORANGE, alpha=0.2, linewidth=0.0)
    above.set_ylabel("input torque [N m]")
    above.legend()
    below.set_ylabel("simulated - measured [N m]")
    below.set_xlabel("time [s]")
    return figure


def points_figure(name: str, residuals: Array, held_out: tuple[Array, Array] | None) -> Figure:
    """Residuals of means over operating points.

    Args:
        name: name of the observable.
        residuals: simulated less recorded means in SI, (points, channels).
        held_out: predicted less measured means and half of their intervals, (points, channels)
            each; None: there are none.
    """
    figure, (axes,) = panels(1)
    axes.plot(np.arange(1, len(residuals) + 1), residuals, "o", color=BLUE)
    if held_out is not None:
        errors, reach = held_out
        place = len(residuals) + np.arange(1, len(errors) + 1)
        for error, half in zip(errors.T, reach.T, strict=True):
            axes.errorbar(place, error, half, fmt="o", color=ORANGE, linewidth=0.8)
    axes.axhline(0.0, color=GREY, linewidth=0.8)
    axes.set_xlabel("operating point; held out: with intervals")
    axes.set_ylabel(f"simulated - measured {name}, SI")
    return figure
