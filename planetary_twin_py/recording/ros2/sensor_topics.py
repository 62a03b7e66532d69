"""Topics of the sensors of a twin, and of those of a measured gearbox, without namespace."""

from __future__ import annotations

from collections.abc import Mapping

SENSORS = "sensors"
"""Below the namespace; `sensors/NAME` is the topic of a sensor."""
TEMPERATURES = ""
"""In place of the name of a sensor: the temperatures of a scene that are states."""
LEVELS = "levels"
"""Below the topic of a sensor with a waveform."""
TEMPERATURE = "sensor_msgs/msg/Temperature"
ENCODERS = "planetary_twin_msgs/msg/EncoderBlock"
SAMPLED = "planetary_twin_msgs/msg/SampledBlock"
PULSES = "planetary_twin_msgs/msg/PulseTimes"
OF_LEVELS = "planetary_twin_msgs/msg/SensorLevels"
OF_THERMAL = "planetary_twin_msgs/msg/ThermalState"
THERMAL_STATE, OIL_TEMPERATURE = "thermal_state", "oil_temperature"
OF_TEMPERATURES = {THERMAL_STATE: OF_THERMAL, OIL_TEMPERATURE: TEMPERATURE}
"""Topics of the temperatures of a scene that are states, and their types."""
KINDS = {
    "accelerometer": SAMPLED,
    "torque": SAMPLED,
    "proximity": SAMPLED,
    "encoder": ENCODERS,
    "tachometer": PULSES,
    "thermometer": TEMPERATURE,
}
"""Types of the messages by the kind of a sensor."""


def sensor_topic(name: str) -> str:
    """Topic of the sensor `name`."""
    return f"{SENSORS}/{name}"


def levels_topic(name: str) -> str:
    """Topic of the levels of the sensor `name`."""
    return f"{SENSORS}/{name}/{LEVELS}"


def sensor_topics(kinds: Mapping[str, str]) -> dict[str, str]:
    """Types of the topics of sensors and temperatures by name.

    Args:
        kinds: kind of each sensor by its name, see `KINDS`; temperatures have no name.
    """
    found = dict(OF_TEMPERATURES) if TEMPERATURES in kinds else {}
    for name, kind in kinds.items():
        if name == TEMPERATURES:
            continue
        found[sensor_topic(name)] = KINDS[kind]
        if KINDS[kind] == SAMPLED:
            found[levels_topic(name)] = OF_LEVELS
    return found


def is_beside(topic: str, namespace: str) -> bool:
    """Whether a topic may be of a sensor of the twin in `namespace`, or of no twin."""
    return topic.startswith(f"{namespace}/") or f"/{SENSORS}/" not in topic
