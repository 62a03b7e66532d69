"""What an accelerometer would have recorded of a run."""

from __future__ import annotations

import warnings
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..model.layout import Layout
from ..scene import Scene
from ..scene.given import check_scene
from ..scene.sensors import Accelerometer
from ..scene.sensors.rules import errors_of_sensor
from ..scene.sensors.sensor import LEAST_OVERSAMPLING
from ..sensors.aliases import alias_share, mean_force
from ..sensors.bank import SensorBank
from ..sensors.reader import Sampling
from ..sensors.remarks import reading_remarks
from ..sensors.sensed import Readings, Sensed, joined_readings
from ..text.warning_types import AccuracyWarning
from .result import Result

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
    """Record the vibration of the housing that a run causes, with a sensor that it did not have.

    What is sensed is filtered before it is sampled at the rate of the sensor, so what the run has
    up to half its sample rate leaves no aliases (80 dB). What it has above is an alias in the run
    already: with 8 or 16 times the rate of the sensor less of it remains. Its size is estimated
    from what the run has near half its sample rate.

    Args:
        scene: scene of the run.
        result: the run, with a `sample_rate` of 4, 5, ... times the rate of the sensor.
        sensor: the sensor; default: `Accelerometer()`.

    Returns:
        Acceleration [m/s^2] in the time for which the filters have samples: somewhat less than that
        of the run.

    Raises:
        ValueError: the sample rate of the run is no such multiple, the run is shorter than the
            filters, or the sensor does not fit the scene.

    Warns:
        AccuracyWarning: samples are clipped, or aliases may be above 1e-4 of the largest line.
    """
    check_scene(scene)
    sensor = Accelerometer() if sensor is None else sensor
    for line in errors_of_sensor(sensor, scene.surroundings):
        raise ValueError(f"sensor.{line}")
    if len(result.time) < 2:
        raise ValueError(f"result: {len(result.time)} samples: must be at least 2")
    rate = (len(result.time) - 1) / float(result.time[-1] - result.time[0])
    rate = _ratio(rate, sensor) * sensor.rate
    samples, sensed = _all_samples(scene, result, rate)
    readings = _read(sensor, samples, sensed)
    if not len(readings.values):
        raise ValueError(
            f"result: {len(result.time) / rate:.3g} s: must be longer than the filters of the "
            "sensor"
        )
    for line in reading_remarks(readings._replace(aliases=alias_share(sensor, samples, sensed))):
        warnings.warn(line, AccuracyWarning, stacklevel=2)
    return SensorSamples(readings.time, readings.values, readings.clipped)


def _ratio(rate: float, sensor: Accelerometer) -> int:
    ratio, least = round(rate / sensor.rate), LEAST_OVERSAMPLING
    if ratio < least or abs(rate / (ratio * sensor.rate) - 1.0) > RATIO_ERROR:
        raise ValueError(
            f"sample_rate = {rate:g} Hz: must be {least}, {least + 1}, ... times the rate of the "
            f"sensor, {sensor.rate:g} Hz"
        )
    return ratio


def _all_samples(scene: Scene, result: Result, rate: float) -> tuple[Sampling, Sensed]:
    """All samples of a run, for sensors."""
    first, axes = round(float(result.time[0]) * rate), result.axes
    sensed = Sensed(
        first,
        result.angle,
        result.speed,
        result.mesh_force,
        np.empty((len(result.time), 0)),  # a result has no torques, which only transducers read
        None if axes is None else axes.displacement,
        scene.operating_point.oil_temperature,
    )
    force = mean_force(sensed, scene.gearset.planets)
    return Sampling(Layout(scene), rate, first, force), sensed


def _read(sensor: Accelerometer, samples: Sampling, sensed: Sensed) -> Readings:
    bank = SensorBank(samples.layout, [sensor], samples.rate, samples.mean_force)
    return joined_readings([*bank.feed(sensed), *bank.end()])
