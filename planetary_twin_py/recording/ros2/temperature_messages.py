"""Messages of temperatures that are states, once a simulated second."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...run.feedback import FeedbackGain
from ...run.window import Window
from ...scene import Scene
from .fields import ROOM
from .sensor_message import CELSIUS, SensorMessage
from .sensor_topics import OIL_TEMPERATURE, THERMAL_STATE

PEAKS = {"contact_temperature": np.fmax, "specific_film": np.fmin}
"""Extremes of the meshes, by the names of `Damage.peaks`."""


class TemperatureMessages:
    """Makes the messages of a run, window by window.

    Args:
        scene: of the run, with the section `thermal`.
    """

    def __init__(self, scene: Scene) -> None:
        self._planets, self._gain = scene.gearset.planets, FeedbackGain(scene)
        self.begin()

    def begin(self) -> None:
        """Begin another run of the scene."""
        self._gain.begin()
        self._peaks = self._none()

    def of(self, window: Window) -> Iterator[SensorMessage]:
        """Messages at the end of the next window, if a whole second passes in it.

        Args:
            window: the window.

        Yields:
            The temperature of the oil, and ThermalState.
        """
        if window.damage is not None:
            for name, extreme in PEAKS.items():
                self._peaks[name] = extreme(self._peaks[name], window.damage.peaks[name])
        if math.floor(window.end) == math.floor(window.start):
            return
        parts = dict(window.temperatures)
        oil = {"temperature": parts["oil"] - CELSIUS, "variance": 0.0}
        yield SensorMessage(OIL_TEMPERATURE, window.end, oil)
        acting = {"input_speed": window.input_speed, "input_torque": window.input_torque}
        # Eigenvalues have the same bits on all processors in single precision only.
        gain = float(np.float32(self._gain(parts, window.point.model_copy(update=acting))))
        parts["planet"] = parts.pop("planets")  # elsewhere this name is the number of planets
        fields: dict[str, Any] = {
            "simulated_time": window.end, "planets": self._planets, **parts, **window.heat,
            "feedback_gain": gain,
        }  # fmt: skip
        yield SensorMessage(THERMAL_STATE, window.end, {**fields, **self._extremes()})

    def _extremes(self) -> dict[str, Any]:
        """Fields with the extremes of each mesh, which start again."""
        fields = dict[str, Any]()
        for name, values in self._peaks.items():
            for kind, side in enumerate(("sun_planet", "planet_ring")):
                field = np.full(ROOM, np.nan)
                first = kind * self._planets
                field[: self._planets] = values[first : first + self._planets]
                fields[f"{side}_{name}"] = field
        self._peaks = self._none()
        return fields

    def _none(self) -> dict[str, NDArray[np.float64]]:
        return {name: np.full(2 * self._planets, np.nan) for name in PEAKS}
