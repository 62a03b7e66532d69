"""Fields of the messages about axes that move, from the quantities of a window."""

from __future__ import annotations

from typing import Any

import numpy as np

from ...run.axes.motion import AxesMotion
from ...run.axes.window_statistics import axes_statistics
from ...run.window import Window
from ...units.catalogue import AXES_WAVEFORM, COMPONENTS, FLANKS, MEMBERS, SIDES, VECTORS
from .fields import with_room


def axes_state_fields(window: Window) -> dict[str, Any]:
    """Fields of AxesState of a `window` whose axes move."""
    axes = _motion(window)
    planets, statistics = len(axes.mean_load_share), axes_statistics(axes)
    fields: dict[str, Any] = {
        "planets": planets,
        "simulated_time": window.end,
        "interval": window.end - window.start,
        "sample_rate": window.sample_rate,
        "load_sharing_factor": float(axes.mean_load_share.max()),  # of the interval
        "load_share": with_room(axes.mean_load_share),
    }
    for name in FLANKS:
        of_sides = statistics.pop(name).reshape(len(SIDES), planets)
        fields |= {f"{side}_{name}": with_room(of_sides[k]) for k, side in enumerate(SIDES)}
    for name, values in statistics.items():
        for body, member in enumerate(MEMBERS):
            fields |= _named(member, name, values[body])
        if len(values) > len(MEMBERS):
            fields |= {
                field: with_room(value)
                for field, value in _named("planet", name, values[len(MEMBERS) :].T).items()
            }
    return fields


def _motion(window: Window) -> AxesMotion:
    if window.axes is None:
        raise ValueError("the axes of this scene are held")
    return window.axes


def largest_of_kind(message: Any, name: str) -> float:
    """Largest displacement or force of any body, to which differences of a component are compared.

    Args:
        message: AxesState.
        name: name of a field.

    Returns:
        Largest value of the same quantity over all bodies [m] or [N]; 0 for other fields.
    """
    for kinds, largest in _OF_KIND.items():
        if any(f"_{kind}" in name for kind in kinds):
            return max(float(np.nanmax(np.abs(getattr(message, field)))) for field in largest)
    return 0.0


_OF_KIND = {
    ("displacement", "orbit"): [f"{body}_displacement_peak" for body in COMPONENTS],
    ("bearing_force",): [f"{body}_bearing_force_peak" for body in COMPONENTS],
    tuple(FLANKS): [f"{side}_{name}" for side in SIDES for name in FLANKS],
}
"""Fields that have the largest values, by the names of the quantities."""


def axes_waveform_fields(window: Window) -> dict[str, Any]:
    """Fields of AxesWaveform of a `window` whose axes move and whose waveform is not empty."""
    wave, axes = window.waveform, _motion(window)
    return {
        "start_time": float(wave.time[0]),
        "sample_period": wave.period,
        "planets": len(axes.mean_load_share),
        "samples": len(wave.time),
        **{name: _samples(getattr(axes, name)) for name in AXES_WAVEFORM},
    }


def _named(body: str, name: str, values: np.ndarray) -> dict[str, Any]:
    """A quantity of a kind of body, or both of its components."""
    if name not in VECTORS:
        return {f"{body}_{name}": values if values.ndim else float(values)}
    return {
        f"{body}_{name}_{component}": value if value.ndim else float(value)
        for component, value in zip(COMPONENTS[body], values, strict=True)
    }


def _samples(values: np.ndarray) -> np.ndarray:
    """Samples (samples, bodies, 2) in the order of the message."""
    return np.ascontiguousarray(values.transpose(1, 2, 0), dtype=np.float32).ravel()
