"""Heat of a scene by source over temperature, from quasi-static steady running.

Faults, errors, runout and torque ripple are left out, and axes are held: their loss is close to
that of the ideal train. Each source is known over its own temperature: the friction of a mesh over
the mean temperature of its gears, the others over that of the oil.
"""

from __future__ import annotations

from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..scene import Scene
from ..scene.errors import Errors
from ..scene.live import PORT_FIELDS
from ..scene.mesh import Runout
from ..scene.other_dynamics import under
from ..scene.thermal import COLDEST, HOTTEST
from .quasi_static.engine import QuasiStaticEngine

Array = NDArray[np.float64]

TOLERANCE = 1e-4
STEP = 10.0  # [K] between the temperatures


class HeatCurve:
    """Heat by source over temperature.

    Args:
        scene: the scene, whose operating point counts.

    Raises:
        ValueError: the scene has no equilibrium there.
    """

    def __init__(self, scene: Scene) -> None:
        count = round((HOTTEST - COLDEST) / STEP) + 1
        self.temperature = np.linspace(COLDEST, HOTTEST, count)
        """[K], (n,)"""
        self.heat = heat_over(scene, self.temperature)
        """[W], (n, sources)"""

    def __call__(self, temperature: Array, slope: bool = False) -> Array:
        """Heat of each source at its own temperature.

        Args:
            temperature: of each source [K], (..., sources); beyond the curve its ends hold.
            slope: whether to return the derivative with respect to the temperature instead.

        Returns:
            Heat [W] or its derivative [W/K], (..., sources).
        """
        inside = np.clip(temperature, COLDEST, HOTTEST)
        curves = self._slopes if slope else self._curves
        found = np.stack([curve(inside[..., n]) for n, curve in enumerate(curves)], axis=-1)
        return np.where(slope & (inside != temperature), 0.0, found)

    @cached_property
    def steepest(self) -> Array:
        """Largest slope of each source between two temperatures [W/K], (sources, n - 1)."""
        step = self.temperature[1] - self.temperature[0]
        found = []
        for slope in self._slopes:
            square, linear, first = slope.c
            with np.errstate(divide="ignore", invalid="ignore"):
                turn = np.nan_to_num(np.clip(-0.5 * linear / square, 0.0, step))
            places = np.stack([np.zeros_like(turn), turn, np.full_like(turn, step)])
            found.append(np.abs((square * places + linear) * places + first).max(axis=0))
        return np.array(found)

    @cached_property
    def _curves(self) -> list[Any]:
        from scipy.interpolate import PchipInterpolator

        return [PchipInterpolator(self.temperature, row) for row in self.heat.T]

    @cached_property
    def _slopes(self) -> list[Any]:
        return [curve.derivative() for curve in self._curves]


def steady_scene(scene: Scene) -> Scene:
    """The same gearbox in quasi-static steady running of machines, without faults and errors.

    Args:
        scene: any scene.
    """
    left_out = under(scene, "quasi_static") | {"faults": (), "errors": Errors()}
    return scene.model_copy(update=left_out).replace(
        torque_ripple=0.0,
        **{"mesh.runout": Runout().model_dump(), "drive.speed_control.start_speed": None},
        **dict.fromkeys(PORT_FIELDS, "machine"),
    )


def heat_over(scene: Scene, temperatures: Array) -> Array:
    """Heat by source in steady running, with one temperature of oil and gears.

    Args:
        scene: the scene, whose operating point counts.
        temperatures: of oil and gears [K], (n,).

    Returns:
        Means over a mesh cycle [W], (n, sources).

    Raises:
        ValueError: the scene has no equilibrium there.
    """
    plain = steady_scene(scene.model_copy(update={"thermal": None}))
    engine, heat = QuasiStaticEngine(plain, TOLERANCE), []
    for temperature in temperatures:
        point = plain.operating_point.model_copy(update={"oil_temperature": float(temperature)})
        engine.change(point, TOLERANCE, 0)
        heat.append(engine.mean_heat())
    return np.array(heat)
