"""Reports in /diagnostics the temperatures of a scene in which they are states."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from planetary_twin_py.recording.runs.slow_states import TEMPERATURES

from ...base.diagnostics import Row, checked

HIGH_GAIN = 0.8  # above, a steady state is close to becoming unstable


def temperature_row(fields: Mapping[str, Any]) -> Row:
    """Return the report on the last message ThermalState: WARN from a feedback gain of 0.8 on."""
    gain = fields["feedback_gain"]
    values = {name: f"{fields[name]:.6g}" for name in TEMPERATURES} | {
        "feedback_gain": f"{gain:.4g}"
    }
    fault = None
    if gain >= HIGH_GAIN:
        becomes = "grow" if gain >= 1.0 else "decay slowly"
        fault = f"feedback gain {gain:.3g}: small changes of the temperatures {becomes}"
    sound = f"oil {fields['oil']:.5g} K, feedback gain {gain:.3g}"
    return checked("simulation: temperatures", fault, sound, values)
