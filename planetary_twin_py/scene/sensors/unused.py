"""Fields of a sensor that have no effect."""

from __future__ import annotations

from . import AnySensor


def unused_of_sensor(sensor: AnySensor, field: str) -> str | None:
    """Why a field of a sensor has no effect.

    Args:
        sensor: the sensor.
        field: dotted name of the field in the sensor, such as "path.power".

    Returns:
        The reason, with the setting that gives the field an effect; None if it has one.
    """
    if field == "seed" and sensor.noise == 0.0:
        return "the sensor has no noise (noise = 0)"
    if sensor.kind == "encoder":
        if field in ("radius", "phase", "heads") and sensor.eccentricity == 0.0:
            return "the disc is on its axis (eccentricity = 0)"
        return None
    if field == "bits" and getattr(sensor, "range", 0.0) is None:
        return "without a range nothing is converted; set range"
    if sensor.kind != "accelerometer":
        return None
    if field == "damping_ratio" and sensor.resonance is None:
        return "the sensor has no resonance; set resonance"
    path = sensor.path
    shape = {"path.power": "cosine", "path.decay": "exponential"}.get(field)
    if shape and getattr(path, "shape", shape) != shape:
        return f"path.shape = {getattr(path, 'shape', '')}; set path.shape = {shape}"
    if field == "path.radius" and path.law == "rigid" and sensor.direction == "radial":
        return "a radial sensor does not show the rotation of the ring; set direction = tangential"
    return None
