"""Samples of a simulated result as a file: arrays in .npz, columns in .csv."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import yaml

from ...run.axes.motion import AxesMotion
from ...run.result import Result
from ...scene import Scene
from ...units.catalogue import COMPONENTS, SAMPLED

_AXES = ("displacement", "bearing_force", "orbit", "flank_force", "load_share")
_TILTING = ("axial_displacement", "axial_force", "tilt", "tilting_moment")


def write_npz(result: Result, scene: Scene, path: Path) -> None:
    """Write the samples of a result as arrays, and the readings of its sensors, with the scene.

    Args:
        result: result of a run.
        scene: its scene.
        path: file ending in .npz.

    Raises:
        OSError: the file cannot be written.
    """
    arrays: dict[str, Any] = {
        name: getattr(result, name) for name in ("time", "angle", "speed", *SAMPLED)
    }
    if result.axes is not None:
        arrays |= {name: getattr(result.axes, name) for name in _AXES}
        arrays["axes"] = result.axes.bodies
        if result.axes.tilting is not None:
            arrays |= result.axes.tilting._asdict()
    for name, readings in result.sensors.items():
        parts = {"time": readings.time, "values": readings.values, "unit": readings.unit}
        arrays |= {f"sensors.{name}.{part}": value for part, value in parts.items()}
    text = yaml.safe_dump(scene.model_dump(mode="json"), sort_keys=False)
    arrays |= {"bodies": result.bodies, "meshes": result.meshes, "scene_yaml": text}
    np.savez_compressed(path, **arrays)


def write_csv(result: Result, _: Scene, path: Path) -> None:
    """Write the samples of a result as columns, named by quantity and body or mesh.

    Args:
        result: result of a run.
        path: file ending in .csv.

    Raises:
        OSError: the file cannot be written.
    """
    columns = dict(_columns(result))
    samples, header = np.column_stack([*columns.values()]), ",".join(columns)
    np.savetxt(path, samples, delimiter=",", header=header, comments="")


WRITERS: dict[str, Callable[[Result, Scene, Path], None]] = {".npz": write_npz, ".csv": write_csv}
"""Functions that write the samples of a result, by suffix of the file."""


def _columns(result: Result) -> Iterator[tuple[str, np.ndarray]]:
    """Name and samples of every time series."""
    yield "time", result.time
    for names, quantities in ((result.bodies, ("angle", "speed")), (result.meshes, SAMPLED)):
        for quantity in quantities:
            for name, samples in zip(names, getattr(result, quantity).T, strict=True):
                yield f"{quantity}/{name}", samples
    if result.axes is not None:
        yield from _axes_columns(result.axes)


def _axes_columns(motion: AxesMotion) -> Iterator[tuple[str, np.ndarray]]:
    """The same of the axes: vectors by component, axial motion and tilts where axes tilt."""
    series = {"displacement": motion.displacement, "bearing_force": motion.bearing_force}
    if motion.tilting is not None:
        series |= {name: getattr(motion.tilting, name) for name in _TILTING}
    for k, body in enumerate(motion.bodies):
        for quantity, values in series.items():
            if values.ndim == 2:
                yield f"{quantity}/{body}", values[:, k]
                continue
            for n, component in enumerate(COMPONENTS[body.partition("_")[0]]):
                yield f"{quantity}/{body}/{component}", values[:, k, n]
    for k, share in enumerate(motion.load_share.T, 1):
        yield f"load_share/planet_{k}", share
