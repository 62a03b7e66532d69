"""Writes measured waveforms as a recording: blocks of samples beside the turning of the gears.

The gears are rigid: their angles follow from that of one shaft. What was not measured is NaN.
"""

from __future__ import annotations

import math
import time
from collections.abc import Mapping
from itertools import pairwise
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from rosbags.interfaces import Nodetype
from rosbags.typesys import get_types_from_msg

from ...model.clock import TICKS
from ...model.layout import Layout
from ...scene import Scene
from ..ros2.bag import write_as
from ..ros2.definitions import topics_of
from ..ros2.fields import ROOM
from ..ros2.metadata import Topic
from ..ros2.sensor_topics import sensor_topic
from ..ros2.topics import DESCRIPTION, JOINTS, ORIGIN, POINT, STATE
from ..runs.compose import Composer, Row, new_bag
from ..runs.offline import NAMESPACE
from ..runs.origin import Measured, Origin
from ..runs.schedule import nanoseconds

Array = NDArray[np.float64]
STEP = TICKS // 100  # [ticks] length of an interval, 10 ms
BLOCK = 0.1  # [s] length of a block of samples
SIDES = "input", "output"


class MeasuredWaveform(NamedTuple):
    """Samples of one sensor at equal steps."""

    unit: str
    first: float
    """Time of the first sample [s], not negative."""
    period: float
    """[s]."""
    values: Array
    """(n,)."""


class MeasuredTurning(NamedTuple):
    """How the input shaft turned, and torques, at the ends of intervals of 10 ms from time 0 on."""

    angle: Array
    """Of the input shaft, also at time 0 [rad], (intervals + 1,)."""
    torque: Mapping[str, Array]
    """Mean over each interval of "input", "output" or both [N m], (intervals,)."""


def write_waveforms(
    sensors: Mapping[str, MeasuredWaveform],
    pulses: Array | None,
    turning: MeasuredTurning,
    scene: Scene,
    source: str,
    out: Path,
) -> Path:
    """Write a recording.

    Args:
        sensors: samples by name of the sensor.
        pulses: times of the pulses of a tachometer, which is called `tachometer` [s]; None without.
        turning: of the input shaft.
        scene: of the gearbox; a second input has its speed.
        source: name of the file with the samples.
        out: a bag folder, or a file that ends in .mcap.

    Raises:
        FileExistsError: `out` exists.
        OSError: it cannot be written.
    """
    kinds = dict.fromkeys(sensors, "accelerometer")  # whose messages are those of any waveform
    if pulses is not None:
        kinds["tachometer"] = "tachometer"
    topics = [
        topic
        for topic in topics_of(NAMESPACE, sensors=kinds)
        if topic.name.removeprefix(f"{NAMESPACE}/")
        in (ORIGIN, DESCRIPTION, POINT, STATE, JOINTS, *map(sensor_topic, kinds))
    ]
    steps = len(turning.angle) - 1
    mean = float(turning.angle[-1] - turning.angle[0]) / (steps * STEP / TICKS)
    scene = scene.replace(input_speed=mean)
    states = _states(turning, scene, topics)

    def write(folder: Path) -> Path:
        with new_bag(folder, scene) as bag:
            composer = Composer(bag, topics, NAMESPACE)
            origin = Origin(scene, time.time_ns(), Measured(source))
            composer.begin(origin)
            composer.point(scene.live_values, 0.0, origin.begins)
            _compose(composer, origin, states, sensors, pulses)
        return bag.file

    return write_as(out, write)


def _compose(
    composer: Composer,
    origin: Origin,
    states: list[tuple[Row, Row]],
    sensors: Mapping[str, MeasuredWaveform],
    pulses: Array | None,
) -> None:
    """Write all messages in the order of the ends of their times."""
    messages: list[tuple[int, str, int, Row]] = []  # end and begin [ns] since time 0
    for number, (state, joints) in enumerate(states, 1):
        end = nanoseconds(number * STEP)
        messages += [(end, STATE, end, state), (end, JOINTS, end, joints)]
    for name, waveform in sensors.items():
        topic, count = sensor_topic(name), max(round(BLOCK / waveform.period), 1)
        for begin in range(0, len(waveform.values), count):
            part = waveform.values[begin : begin + count]
            first = waveform.first + begin * waveform.period
            row: Row = {
                "sample_period": waveform.period,
                "names": [name],
                "units": [waveform.unit],
                "samples": part.astype(np.float32),
            }
            end = round((first + len(part) * waveform.period) * 1e9)
            messages.append((end, topic, round(first * 1e9), row))
    if pulses is not None:
        for begin, end in pairwise(range(math.floor(pulses[0]), math.ceil(pulses[-1]) + 2)):
            part = pulses[(pulses >= begin) & (pulses < end)]
            if len(part):
                at = round(float(part[0]) * 1e9)
                messages.append(
                    (round(float(part[-1]) * 1e9), sensor_topic("tachometer"), at, {"times": part})
                )
    for end, topic, begin, row in sorted(messages, key=lambda each: each[0]):
        composer.write(topic, row, origin.begins + begin, origin.begins + end)


def _states(turning: MeasuredTurning, scene: Scene, topics: list[Topic]) -> list[tuple[Row, Row]]:
    """Fields of GearboxState and JointState of each interval; NaN for what was not measured."""
    state = next(topic for topic in topics if topic.name.endswith(f"/{STATE}"))
    fields = get_types_from_msg(state.definition, state.type)[state.type][1]
    empty: Row = {
        name: np.full(ROOM, math.nan) if kind == Nodetype.ARRAY else math.nan
        for name, (kind, _) in fields
        if name not in ("header", "sequence")
    }
    layout, planets, step = Layout(scene), scene.gearset.planets, STEP / TICKS
    machines = {"input": "motor", "output": "load"}
    angles = {
        body: float(layout.ratios[body][0]) * turning.angle
        + _of_second(scene, layout, body) * step * np.arange(len(turning.angle))
        for body in ("sun", "planet", "ring", "carrier", *machines.values())
    }
    speeds = {body: np.diff(angle) / step for body, angle in angles.items()}
    at_stamps = {body: np.gradient(angles[body], step)[1:] for body in machines.values()}
    angles = {body: np.mod(angle, math.tau) for body, angle in angles.items()}
    cycles = scene.gearset.teeth.sun * np.abs(speeds["sun"] - speeds["carrier"]) / math.tau
    found = []
    for k in range(len(turning.angle) - 1):
        row = empty | {"simulated_time": (k + 1) * step, "interval": step, "planets": planets}
        for body in ("sun", "ring", "carrier"):
            row |= {f"{body}_angle": angles[body][k + 1], f"{body}_speed": speeds[body][k]}
        for field, value in (
            ("planet_angle", angles["planet"][k + 1]),
            ("planet_speed", speeds["planet"][k]),
        ):
            row[field] = np.full(ROOM, math.nan)
            row[field][:planets] = value
        row["mesh_frequency"] = cycles[k]
        torque = [turning.torque[side][k] if side in turning.torque else math.nan for side in SIDES]
        velocity = [float(at_stamps[machines[side]][k]) for side in SIDES]
        for side, moment in zip(SIDES, torque, strict=True):
            row |= {f"{side}_torque": moment, f"{side}_speed": speeds[machines[side]][k]}
        joints: Row = {
            "name": [f"{side}_joint" for side in SIDES],
            "position": np.empty(0),
            "velocity": np.array(velocity),
            "effort": np.array(torque) if turning.torque else np.empty(0),
        }
        found.append((row, joints))
    return found


def _of_second(scene: Scene, layout: Layout, body: str) -> float:
    """Part of the speed of a body that is of the second input [rad/s]."""
    further = layout.ratios[body][1:]
    return sum(float(ratio) * scene.operating_point.second_input_speed for ratio in further)
