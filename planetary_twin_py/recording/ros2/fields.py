"""Fields of the twin's messages, from the quantities of a window."""

from __future__ import annotations

from typing import Any

import numpy as np

from ...run.window import Window
from ...units.catalogue import MEMBERS, SIDES, TRAIN, WAVEFORM

ROOM = 7  # largest number of planets in a message
TURN = 2.0 * np.pi  # [rad]


def mesh_field(name: str, planets: int) -> tuple[str, int] | None:
    """Statistic and first mesh of a per-mesh field of GearboxState; None for other fields."""
    for side, first in zip(SIDES, (0, planets), strict=True):
        if name.startswith(f"{side}_"):
            return name.removeprefix(f"{side}_"), first
    return None


def state_fields(window: Window, names: list[str]) -> dict[str, Any]:
    """Fields of GearboxState: the general ones, and the per-mesh fields among `names`."""
    planets = len(window.meshes) // 2
    fields: dict[str, Any] = {
        "planets": planets,
        "simulated_time": window.end,
        "interval": window.end - window.start,
    }
    fields |= {name: float(getattr(window, name)) for name in TRAIN}
    for member in MEMBERS:
        body = window.bodies.index(member)
        fields[f"{member}_angle"] = float(window.angle[body])
        fields[f"{member}_speed"] = float(window.mean_speed[body])
    first = window.bodies.index("planet_1")
    fields["planet_angle"] = with_room(window.angle[first : first + planets])
    fields["planet_speed"] = with_room(window.mean_speed[first : first + planets])
    for name in names:
        if shown := mesh_field(name, planets):
            statistic, mesh = shown
            fields[name] = with_room(window.mesh[statistic][mesh : mesh + planets])
    return fields


def waveform_fields(window: Window) -> dict[str, Any]:
    """Fields of MeshWaveform of a `window` whose waveform is not empty."""
    wave = window.waveform
    return {
        "start_time": float(wave.time[0]),
        "sample_period": wave.period,
        "planets": len(window.meshes) // 2,
        "samples": len(wave.time),
        **{name: getattr(wave, name).T.astype(np.float32).ravel() for name in WAVEFORM},
    }


def joint_fields(window: Window) -> dict[str, Any]:
    """Fields of JointState."""
    return {
        "position": window.angle,
        "velocity": window.mean_speed,
        "effort": window.shaft_torque,
    }


def joint_fields_like(window: Window, message: Any) -> dict[str, Any]:
    """
    Fields of JointState that a recorded message has, with its whole turns.

    Args:
        window: an interval.
        message: a recorded message. The whole turns of its positions depend on the start of the
            run, so they are used here, with the remainder from `window`. Earlier versions recorded
            no torques.
    """
    fields, recorded = joint_fields(window), np.asarray(message.position)
    if not len(message.effort):
        del fields["effort"]
    if recorded.shape == window.angle.shape:
        turns = np.rint((recorded - window.angle) / TURN)
        fields["position"] = window.angle + TURN * np.where(np.isfinite(turns), turns, 0.0)
    return fields


def with_room(values: np.ndarray) -> np.ndarray:
    """Values of planets, and NaN up to the length of arrays in messages."""
    filled = np.full(ROOM, np.nan)
    filled[: len(values)] = values
    return filled
