"""Reads damage and temperatures of a twin from a recording."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...scene.thermal import NODES
from ...units.catalogue import SIDES
from ..ros2.sensor_topics import THERMAL_STATE
from ..ros2.topics import DAMAGE
from ..ros2.typestore import is_recorded
from .schedule import messages_of, stamp_of

TEMPERATURES = (*("planet" if name == "planets" else name for name in NODES), "ambient")
"""Fields of ThermalState [K]."""
HOTTEST = ("sun_planet_contact_temperature", "planet_ring_contact_temperature")
"""Those with extremes of the contact temperature of each mesh [K]."""
FILMS = ("sun_planet_specific_film", "planet_ring_specific_film")
"""Those with extremes of the specific film of each mesh [-]."""


class SlowStates(NamedTuple):
    """Quantities that are published about once a second."""

    names: tuple[str, ...]
    """Their names."""
    time: NDArray[np.float64]
    """Simulated time [s], (n,)."""
    stamp: NDArray[np.int64]
    """ROS time [ns], (n,)."""
    values: NDArray[np.float64]
    """Values, (n, names)."""


class ThermalStates(NamedTuple):
    """What the messages ThermalState contain."""

    temperatures: SlowStates
    """Of the parts [K]."""
    hottest: SlowStates | None
    """Highest contact temperature of each mesh in a period [K]; None if it is not known."""
    thinnest: SlowStates | None
    """Smallest specific film of each mesh in a period [-]; None if it is not known."""


def read_damage(path: Path, namespace: str, topics: frozenset[str]) -> SlowStates | None:
    """Read the damage of a twin, by parts.

    Args:
        path: path of an .mcap file, or of a folder of them.
        namespace: namespace of the gearbox.
        topics: names of the topics in the files.

    Returns:
        Miner sums; None if there are none.

    Raises:
        RecordingError: a message does not match its definition.
    """
    found = _messages(path, namespace, topics, DAMAGE)
    return _states(found, found[0].parts, lambda message: message.damage) if found else None


def read_thermal(path: Path, namespace: str, topics: frozenset[str]) -> ThermalStates | None:
    """Read the temperatures of a twin, and the extremes of its meshes.

    Args:
        path: path of an .mcap file, or of a folder of them.
        namespace: namespace of the gearbox.
        topics: names of the topics in the files.

    Returns:
        Temperatures and extremes; None if there are none.

    Raises:
        RecordingError: a message does not match its definition.
    """
    found = _messages(path, namespace, topics, THERMAL_STATE)
    if not found:
        return None
    temperatures = _states(
        found, TEMPERATURES, lambda message: [getattr(message, name) for name in TEMPERATURES]
    )
    return ThermalStates(temperatures, _extremes(found, HOTTEST), _extremes(found, FILMS))


def _extremes(found: list[Any], fields: Sequence[str]) -> SlowStates | None:
    """Extremes by mesh; None if there are none."""
    if not is_recorded(found[0], fields[0]):
        return None
    values = np.array([[getattr(each, name) for name in fields] for each in found])
    known = np.flatnonzero(np.isfinite(values).any(axis=(0, 1)))
    if not len(known):
        return None
    planets = int(known[-1]) + 1
    names = [f"{side}_{n + 1}" for side in SIDES for n in range(planets)]
    rows = iter(values[:, :, :planets].reshape(len(found), -1))
    return _states(found, names, lambda _: next(rows))


def _messages(path: Path, namespace: str, topics: frozenset[str], topic: str) -> list[Any]:
    if f"{namespace}/{topic}" not in topics:
        return []
    return [message for _, message in messages_of(path, namespace, (topic,), [])]


def _states(
    found: list[Any], names: Sequence[str], values: Callable[[Any], Sequence[float]]
) -> SlowStates:
    return SlowStates(
        tuple(names),
        np.array([message.simulated_time for message in found]),
        np.array([stamp_of(message) for message in found], dtype=np.int64),
        np.array([values(message) for message in found]),
    )
