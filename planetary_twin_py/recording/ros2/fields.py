"""Fields of the twin's messages, from the quantities of a window."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any, NamedTuple

import numpy as np

from ...run.window import Window
from ...units.catalogue import MEMBERS, SIDES, TRAIN, WAVEFORM

ROOM = 7  # largest number of planets in a message
TURN = 2.0 * np.pi  # [rad]


class MeshField(NamedTuple):
    """A field of GearboxState with a value for each mesh of one kind."""

    name: str
    statistic: str
    first: int
    """Number of the first mesh."""


def mesh_fields(names: Iterable[str], planets: int) -> list[MeshField]:
    """Per-mesh fields among the `names` of fields of GearboxState."""
    return [
        MeshField(name, name.removeprefix(f"{side}_"), first)
        for name in names
        for side, first in zip(SIDES, (0, planets), strict=True)
        if name.startswith(f"{side}_")
    ]


def state_numbers(window: Window) -> dict[str, float]:
    """Fields of GearboxState that are numbers."""
    numbers = {"simulated_time": window.end, "interval": window.end - window.start}
    numbers |= {name: float(getattr(window, name)) for name in TRAIN}
    for member in MEMBERS:
        body = window.bodies.index(member)
        numbers[f"{member}_angle"] = float(window.angle[body])
        numbers[f"{member}_speed"] = float(window.mean_speed[body])
    return numbers


def state_of_planets(window: Window, meshes: Iterable[MeshField]) -> dict[str, np.ndarray]:
    """Fields of GearboxState with a value for each planet, and those of `meshes`."""
    planets = len(window.meshes) // 2
    first = window.bodies.index("planet_1")
    return {
        "planet_angle": window.angle[first : first + planets],
        "planet_speed": window.mean_speed[first : first + planets],
        **{name: window.mesh[statistic][mesh : mesh + planets] for name, statistic, mesh in meshes},
    }


def state_fields(window: Window, names: list[str]) -> dict[str, Any]:
    """Fields of GearboxState: the general ones, and the per-mesh fields among `names`."""
    planets = len(window.meshes) // 2
    arrays = state_of_planets(window, mesh_fields(names, planets))
    return {
        "planets": planets,
        **state_numbers(window),
        **{name: with_room(values) for name, values in arrays.items()},
    }


def waveform_fields(window: Window) -> dict[str, Any]:
    """Fields of MeshWaveform of a `window` whose waveform is not empty."""
    wave = window.waveform
    return {
        "start_time": float(wave.time[0]),
        "sample_period": wave.period,
        "planets": len(window.meshes) // 2,
        "samples": len(wave.time),
        **{name: np.ravel(getattr(wave, name).T.astype(np.float32, "C")) for name in WAVEFORM},
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
