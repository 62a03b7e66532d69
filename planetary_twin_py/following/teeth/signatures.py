"""Signatures: the effect of a cracked tooth on the averaged transmission error, from the model.

The model runs with one cracked tooth of the sun, of each planet and of the ring. Signatures of the
other teeth are shifted by whole mesh cycles: tooth t of a gear meets t cycles after tooth 0.
"""

from __future__ import annotations

from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...scene import Scene
from ..train import FollowedTrain, followed_train
from ..transmission_error import model_error
from .hunting_blocks import BINS, SMOOTHED, without_common

Array = NDArray[np.float64]

LOSS = 0.05  # loss of stiffness for which a signature is computed
CYCLES = 280  # smallest number of mesh cycles that are averaged
POINTS = 80  # samples in a mesh cycle
SETTLING = 1.0  # [s] in which vibration of the couplings decays
TOLERANCE = 1e-5
STEP = 0.05  # relative change of the torque for the compliance


class Signatures(NamedTuple):
    """Signatures at one torque and speed."""

    torque: float
    """Input torque [N m]."""
    gears: dict[str, Array]
    """Deviation by tooth 0 per unit of stiffness loss, by gear [m], (teeth, BINS)."""
    compliance: float
    """Derivative of the mean transmission error over the torque [m/(N m)]."""


def signatures(scene: Scene, torque: float, speed: float) -> Signatures:
    """Compute the signatures of all gears at an input torque [N m] and speed [rad/s].

    Faults of the scene are omitted. Raises `SceneError` beyond the limits of the scene, and
    `RunawayError` if it cannot run at this point.
    """
    return _signatures(scene.model_dump_json(), torque, speed)


@lru_cache(maxsize=16)
def _signatures(text: str, torque: float, speed: float) -> Signatures:
    scene = Scene.model_validate_json(text)
    train = followed_train(scene)
    plain = scene.replace(
        faults=(), input_torque=torque, input_speed=speed, torque_ripple=0.0,
        **{"drive.speed_control.start_speed": None},
    )  # fmt: skip
    by_gear = {gear: _signature(plain, train, gear) for gear in train.teeth}
    mean_errors = [
        float(np.mean(_error(plain.replace(input_torque=t), 2 * SMOOTHED)[1]))
        for t in (torque, torque * (1.0 + STEP))
    ]
    return Signatures(torque, by_gear, (mean_errors[1] - mean_errors[0]) / (STEP * torque))


def _signature(scene: Scene, train: FollowedTrain, gear: str) -> Array:
    """Deviation of tooth 0 of a gear per unit of loss [m], (teeth, BINS)."""
    kind, _, planet = gear.partition("_")
    fault = {"kind": "crack", "gear": kind, "tooth": 0, "stiffness_loss": LOSS}
    if planet:
        fault["planet"] = int(planet)
    return _deviation(scene.replace(faults=[fault]), train.teeth[gear]) / LOSS


def _deviation(scene: Scene, teeth: int) -> Array:
    """Mean deviation over the turns of a gear [m], (teeth, BINS)."""
    first, error = _error(scene, teeth * -(-CYCLES // teeth))
    mean_turn = error.reshape(-1, teeth * POINTS).mean(axis=0)
    turn = np.roll(mean_turn, first % (teeth * POINTS))
    bin_means = (turn - turn.mean()).reshape(teeth * BINS, -1).mean(axis=1)
    window = np.zeros(teeth * BINS)
    reach = SMOOTHED * BINS // 2
    for step in range(-reach, reach + 1):
        window[step % len(window)] += 0.5 if abs(step) == reach else 1.0
    running_mean = (
        np.fft.irfft(np.fft.rfft(bin_means) * np.fft.rfft(window), len(bin_means)) / window.sum()
    )
    deviation = (bin_means - running_mean).reshape(teeth, BINS)
    return without_common(deviation, np.ones(deviation.shape, dtype=bool))


def _error(scene: Scene, cycles: int) -> tuple[int, Array]:
    return model_error(scene, cycles, POINTS, SETTLING, TOLERANCE)
