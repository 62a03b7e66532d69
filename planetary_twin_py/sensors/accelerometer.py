"""An accelerometer on the housing, from the samples of a run."""

from __future__ import annotations

import math
import warnings
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..run.result import Result
from ..scene import Scene
from ..scene.given import check_scene
from ..scene.sensors import Accelerometer, FlexibleRing
from ..text.warning_types import AccuracyWarning
from .filters import OVERSAMPLING, Path, Response, sampled, unchanged
from .flexible_ring import radial_paths
from .mode import Mode
from .windows import window

Array = NDArray[np.float64]
RATIO_ERROR = 1e-9  # relative, of the ratio of two rates that is a whole number


class SensorSamples(NamedTuple):
    """What a sensor records."""

    time: Array
    """Sample times [s], (n,)."""
    values: Array
    """Samples in the unit of the sensor, (n,)."""
    clipped: int
    """Number of samples beyond the range of the sensor."""


def measure_vibration(
    scene: Scene, result: Result, sensor: Accelerometer | None = None
) -> SensorSamples:
    """Record the vibration of the housing that the ring meshes of a run cause.

    The forces are filtered before they are sampled at the rate of the sensor, so what they have up
    to half the sample rate of the run leaves no aliases (80 dB). What they have above is an alias
    in the run already: with 8 or 16 times the rate of the sensor less of it remains.

    Args:
        scene: scene of the run.
        result: the run, with a `sample_rate` of 4, 5, ... times the rate of the sensor.
        sensor: the sensor; default: `Accelerometer()`.

    Returns:
        Acceleration [m/s^2] in the time for which the filters have samples: somewhat less than that
        of the run.

    Raises:
        ValueError: the sample rate of the run is no such multiple, or the run is shorter than the
            filters.

    Warns:
        AccuracyWarning: samples are clipped.
    """
    check_scene(scene)
    sensor = Accelerometer() if sensor is None else sensor
    if len(result.time) < 2:
        raise ValueError(f"result: {len(result.time)} samples: must be at least 2")
    rate = (len(result.time) - 1) / float(result.time[-1] - result.time[0])
    ratio = _ratio(rate, sensor.rate)
    response, decay = _transducer(sensor)
    values, first = sampled(_paths(scene, result, sensor), response, decay, rate, ratio)
    if not len(values):
        raise ValueError(
            f"result: {len(result.time) / rate:.3g} s: must be longer than the filters of the "
            f"sensor, {first / rate:.3g} s"
        )
    time = result.time[first::ratio][: len(values)]
    chance = np.random.default_rng([sensor.seed])
    values = values + sensor.noise * chance.standard_normal(len(values))
    if sensor.range is None:
        return SensorSamples(time, values, 0)
    clipped = int((np.abs(values) > sensor.range).sum())
    if clipped:
        warnings.warn(
            f"{sensor.name}: {clipped} of {len(values)} samples are beyond the range of "
            f"{sensor.range:g} m/s^2 and clipped",
            AccuracyWarning,
            stacklevel=2,
        )
    step = 2.0 * sensor.range / 2**sensor.bits
    values = np.clip(values, -sensor.range, sensor.range)
    return SensorSamples(time, step * np.round(values / step), clipped)


def _ratio(rate: float, sensor_rate: float) -> int:
    ratio = round(rate / sensor_rate)
    if ratio < OVERSAMPLING or abs(rate / (ratio * sensor_rate) - 1.0) > RATIO_ERROR:
        raise ValueError(
            f"sample_rate = {rate:g} Hz: must be {OVERSAMPLING}, {OVERSAMPLING + 1}, ... times the "
            f"rate of the sensor, {sensor_rate:g} Hz"
        )
    return ratio


def _transducer(sensor: Accelerometer) -> tuple[Response, float]:
    """Response of the sensor itself, and its time constant [s]."""
    if sensor.resonance is None:
        return unchanged, 0.0
    mode = Mode(math.tau * sensor.resonance, sensor.damping_ratio)
    return mode.displacement, mode.decay


def _paths(scene: Scene, result: Result, sensor: Accelerometer) -> list[Path]:
    """What arrives at the sensor, by path."""
    gearset, path = scene.gearset, sensor.path
    carrier = result.angle[:, result.bodies.index("carrier")]
    force = result.mesh_force[:, gearset.planets :]
    place = carrier[:, None] + np.asarray(gearset.planet_angles)
    if isinstance(path, FlexibleRing):
        angle = gearset.geometry.meshes[1].pressure_angle
        return radial_paths(path, force, place, sensor.angle, angle)
    alternating = force - force.mean(axis=0)
    heard = alternating * window(path, gearset.planets, place - sensor.angle)
    return [Path(path.gain * heard.sum(axis=1), unchanged, 0.0)]
