"""Condition of one planet, or of the sun, from a sensor on the housing that the planets pass.

Where the first planet is at the sensor is a statement of the user, or where the power of the
vibration over a turn of the carrier is highest (D'Elia, Mucchi and Dalpiaz 2013, ISMA, find it by
the power of the average).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Literal, cast

import numpy as np

from ...gearset.kinematics import Teeth
from ...model.layout import Layout
from ...scene import Scene
from ..signals.signal import Array, Signal
from .gear_condition import GearCondition, Passing, condition_of, quantisation
from .planet_separation import Separated, separate
from .synchronous_average import SynchronousAverage

PLACES = 360  # of the carrier, at which power is compared
LEAST = 0.1  # power that passes with the planets, over the mean, below which no place is found


def is_passed(scene: Scene, gear: str) -> bool:
    """Whether planets pass a sensor on the housing, so that the teeth of a gear must be separated.

    Args:
        scene: of the gearbox.
        gear: "sun", "planet" or "ring".
    """
    return gear != "ring" and any(Layout(scene).ratios["carrier"])


def separated_condition(
    signal: Signal,
    scene: Scene,
    gear: str,
    planet: int,
    passing: float | None,
    healthy: SynchronousAverage | None,
) -> GearCondition:
    """Condition of a planet or the sun by windows around the passes of one planet.

    Args:
        signal: of the sensor.
        scene: of the gearbox, with one input.
        gear: "planet" or "sun".
        planet: number of the planet, from 1 on. The sun is averaged over its meshes with all.
        passing: angle of the carrier since the first sample at which planet 1 is at the sensor
            [rad]; None finds it.
        healthy: the same average of the healthy gear; None if there is none.

    Raises:
        ValueError: see `separate`; the scene has two inputs, or the ring turns; or the place is not
            found.
    """
    held = scene.gearset.held
    if scene.drive.second_input is not None or held == "carrier":
        raise ValueError(f"gear = {gear!r}: cannot be separated where ring and sun turn; --plain")
    carrier = _carrier_angle(signal, scene)
    angles = np.asarray(scene.gearset.planet_angles) - scene.gearset.planet_angles[0]
    steps = np.diff(np.sort(angles % math.tau), append=math.tau)
    equal = bool(np.allclose(steps, steps[0]))
    place = passing
    if place is None:
        place = _found(signal.samples, carrier, angles)
        place = place % (math.tau / len(angles)) if equal else place
    numbers = [planet] if gear == "planet" else [*range(1, len(angles) + 1)]
    every = [
        separate(
            signal.samples,
            carrier,
            scene.gearset.tooth_numbers,
            scene.gearset.planets,
            cast(Literal["sun", "planet"], gear),
            place - float(angles[number - 1]),
            cast(Literal["ring", "sun"], held),
        )
        for number in numbers
    ]
    done = every[0]
    if gear == "sun":
        sense = math.copysign(1.0, carrier[-1] - carrier[0])
        done = of_all_planets(every, sense * angles, scene.gearset.tooth_numbers)
    teeth = getattr(scene.gearset.tooth_numbers, gear)
    turn = math.tau * done.tooth / teeth
    average = SynchronousAverage(turn, done.average, done.cycles)
    sound = None if healthy is None else healthy.average[np.newaxis]
    found = condition_of(average, teeth, sound, quantisation(signal.samples))
    return found._replace(separated=done, passing=Passing(place, passing is None, equal))


def of_all_planets(every: Sequence[Separated], angles: Array, teeth: Teeth) -> Separated:
    """Average of the sun over its meshes with all planets, from the tooth of the first one on.

    A tooth of the sun meets planet after planet, as the sun turns relative to the carrier.

    Args:
        every: average of the sun in the mesh with each planet.
        angles: of the planets from the first one, in the sense in which the carrier turns [rad].
        teeth: tooth numbers; the ring is held.
    """
    count = min(len(one.cycles) for one in every)
    order = np.arange(len(every[0].tooth) // 2 + 1)
    cycles = np.zeros_like(every[0].cycles[:count])
    for one, angle in zip(every, angles, strict=True):
        later = (teeth.ring * (every[0].first - one.first) + teeth.sun * float(angle)) / teeth.sun
        turned = np.fft.rfft(one.cycles[:count], axis=1) * np.exp(1j * order * later)
        cycles += np.fft.irfft(turned, cycles.shape[1], axis=1) / len(every)
    passes = sum(one.passes for one in every)
    return every[0]._replace(average=cycles.mean(axis=0), cycles=cycles, passes=passes)


def _carrier_angle(signal: Signal, scene: Scene) -> Array:
    """Angle of the carrier since the first sample [rad], (n,)."""
    ratios = Layout(scene).ratios
    ratio = float(ratios["carrier"][0] / (ratios["sun"][0] - ratios["carrier"][0]))
    return ratio * (signal.angle - signal.angle[0])


def _found(samples: Array, carrier: Array, angles: Array) -> float:
    """Angle of the carrier at which planet 1 is at the sensor [rad].

    Power over the angle of the carrier is compared with its highest where planets pass.

    Args:
        samples: of the sensor, (n,).
        carrier: its angle [rad], (n,).
        angles: of the planets from the first one [rad], (planets,).

    Raises:
        ValueError: the power does not change with the passes.
    """
    place = np.floor(carrier * (PLACES / math.tau)).astype(np.int64) % PLACES
    centred = samples - samples.mean()
    seen = np.bincount(place, minlength=PLACES)
    power = np.bincount(place, centred**2, PLACES) / np.maximum(seen, 1)
    # Planet k is there at an angle that is smaller by its own: passes are around -angles.
    orders = np.arange(1, PLACES // 2)
    of_power = np.fft.rfft(power)[1 : PLACES // 2]
    of_passes = np.exp(1j * np.outer(orders, angles)).sum(axis=1) / len(angles)
    smooth = np.where(orders <= 2 * len(angles), 1.0, 0.0)
    match = np.zeros(PLACES // 2 + 1, dtype=complex)
    match[1 : PLACES // 2] = of_power * np.conj(of_passes) * smooth
    course = np.fft.irfft(match, PLACES)
    highest = int(course.argmax())
    if not course[highest] > LEAST * power.mean():
        raise ValueError(
            "passing: the vibration does not change with the passes of the planets, so their place "
            "is not found; state --passing, or --plain for a signal that planets do not pass"
        )
    return math.tau * (highest + 0.5) / PLACES
