"""Starts a run of a scene, dynamic or quasi-static."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ..model.gearbox import Gearbox
from ..model.planet_bearings import check_planet_bearings
from ..model.speed_loop_check import SpeedLoopCheck
from ..scene import OperatingPoint, Scene, SceneError
from ..scene.growth import Table
from ..scene.live import FAULTS
from ..text.escaping import one_line
from .interface import Run
from .port_engine import DrivenEngine
from .quasi_static.engine import QuasiStaticEngine


def start(scene: Scene, tolerance: float, method: str = "auto") -> Run:
    """Start a run of `scene` with the dynamics that it selects.

    Args:
        scene: to simulate.
        tolerance: see `Engine`.
        method: see `Engine`; quasi-static runs have no choice.

    Raises:
        ValueError: an argument is out of range, or the scene cannot be built.
    """
    if scene.dynamics == "auto":
        name = one_line(scene.name, 100)
        raise SceneError(
            "dynamics = 'auto': must be selected first: use `choose_dynamics(scene).scene`, or "
            f"give torsional, planar or quasi_static; `planetary-twin explain {name}` "
            "compares them"
        )
    if not scene.quasi_static:
        return DrivenEngine(scene, tolerance, method)
    if scene.sensors:
        raise SceneError(
            f"sensors: must be empty, because dynamics = {scene.dynamics!r}: sensors measure "
            "vibration, which it does not have"
        )
    if method not in ("auto", "march"):
        raise ValueError(
            f"method = {method!r}: must be auto or march, because dynamics = {scene.dynamics!r}"
        )
    return QuasiStaticEngine(scene, tolerance)


def check_point(scene: Scene, point: OperatingPoint) -> None:
    """Check that a run of `scene` is stable at an operating point.

    Raises:
        ValueError: the speed loop of the drive is not stable, or bearings of planets are too soft.
    """
    gearbox = Gearbox(scene)
    check_planet_bearings(gearbox, point)
    if not scene.quasi_static:
        SpeedLoopCheck(gearbox).check(point)


def check_severities(scene: Scene, values: Mapping[str, Any]) -> None:
    """Check that severities of a running twin may be set.

    Args:
        scene: the scene.
        values: by the arguments of `Twin.set`; other than severities are ignored.

    Raises:
        ValueError: a fault follows a table, a value is out of range, or a tooth cannot have it.
    """
    named = {name: value for name, value in values.items() if name.startswith(FAULTS)}
    for name in named:
        if isinstance(scene.faults[int(name.split(".")[1])].growing, Table):
            raise SceneError(f"{name}: follows growth.time or meshes, so it cannot be set")
    Gearbox(scene.replace(**named)).train  # noqa: B018
