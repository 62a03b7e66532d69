"""What sensors need of the scene they are in, and the rate at which they sample its motion."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from fractions import Fraction
from typing import NamedTuple

from . import Accelerometer, AnySensor, Encoder, Proximity, Tachometer, Torque
from .paths import RigidRing
from .sensor import LEAST_OVERSAMPLING, FilteredSensor

HIGHEST_RATE = 2e6  # [Hz]
PULSE_RATE = 10_000.0  # [Hz] least one of the angles between which pulses are found


def sensing_rate(sensors: Sequence[AnySensor]) -> float:
    """Rate of the samples of the motion from which sensors take theirs.

    Args:
        sensors: the sensors, at least one.

    Returns:
        The lowest common multiple of their rates that is four times the rate of each sensor with a
        filter, `oversampling` times that of an accelerometer, and enough for pulses [Hz].
    """
    rates = [Fraction(str(sensor.rate)) for sensor in sensors if not isinstance(sensor, Tachometer)]
    common = Fraction(
        math.lcm(*(rate.numerator for rate in rates)),
        math.gcd(*(rate.denominator for rate in rates)) or 1,
    )
    least = max(map(_least_rate, sensors))
    return float(common * max(math.ceil(Fraction(str(least)) / common), 1))


def _least_rate(sensor: AnySensor) -> float:
    if isinstance(sensor, Tachometer):
        return PULSE_RATE
    if isinstance(sensor, Accelerometer):
        return sensor.oversampling * sensor.rate
    return LEAST_OVERSAMPLING * sensor.rate if isinstance(sensor, FilteredSensor) else sensor.rate


class Surroundings(NamedTuple):
    """What of a scene its sensors need."""

    held: str
    """Member that is fixed."""
    second_input: bool
    """Whether there is one."""
    dynamics: str


def errors_of_sensors(sensors: Sequence[AnySensor], scene: Surroundings) -> Iterator[str]:
    """Errors of sensors that do not fit their scene, or each other.

    Args:
        sensors: the sensors.
        scene: where they are.
    """
    names = [sensor.name for sensor in sensors]
    for n, sensor in enumerate(sensors):
        if sensor.name in names[:n]:
            first = names.index(sensor.name)
            yield (
                f"sensors.{n}.name = {sensor.name!r}: must differ from sensors.{first}.name, as "
                "each sensor has a topic of its own"
            )
        yield from (f"sensors.{n}.{line}" for line in errors_of_sensor(sensor, scene))
    if sensors and (rate := sensing_rate(sensors)) > HIGHEST_RATE:
        rates = ", ".join(f"{s.rate:g}" for s in sensors if not isinstance(s, Tachometer))
        yield (
            f"sensors: their rates, {rates} Hz, require a common rate of {rate:.7g} Hz: must be at "
            f"most {HIGHEST_RATE:g} Hz; choose rates that divide each other, or less oversampling"
        )


def errors_of_sensor(sensor: AnySensor, scene: Surroundings) -> Iterator[str]:
    """Errors of a sensor that does not fit a scene.

    Args:
        sensor: the sensor.
        scene: where it is.

    Yields:
        A line for each error, which starts with a field of the sensor.
    """
    if isinstance(sensor, (Encoder, Tachometer, Torque)):
        if sensor.shaft == "second_input" and not scene.second_input:
            yield "shaft = 'second_input': the scene has no second input"
        if sensor.shaft == scene.held:
            yield f"shaft = {scene.held!r}: is fixed by gearset.held and does not turn"
    moving = scene.dynamics.endswith(("planar", "spatial"))
    needed = f"requires dynamics = planar or spatial, not {scene.dynamics!r}"
    if isinstance(sensor, Proximity) and not moving:
        yield f"kind = 'proximity': {needed}"
    if isinstance(sensor, Accelerometer) and isinstance(sensor.path, RigidRing):
        if not moving:
            yield f"path.law = 'rigid': {needed}"
        if scene.held != "ring":
            yield f"path.law = 'rigid': requires gearset.held = 'ring', not {scene.held!r}"
