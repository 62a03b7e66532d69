"""Judges single readings: codes for missing values, and values that the machine cannot reach.

Loggers and drivers write a code where a reading is missing, and the end of their range where one
is too large. Both are facts about the channel, and never events of the gearbox.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from .train import FollowedTrain

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]

OIL = "oil_temperature"
CODES = np.sort(
    [
        *(sign * value for value in (999.0, 9999.0, 99999.0, 999999.0) for sign in (-1.0, 1.0)),
        -99.0, -888.0, -8888.0, -7999.0, -6999.0, 32767.0, -32768.0, 32768.0, 65535.0,
        8388607.0, -8388608.0, 2147483647.0, -2147483648.0, 4294967295.0,
    ]
)  # fmt: skip
"""What loggers and converters write for a missing reading, or at the end of their range."""
EXACT = 1e-6  # relative error of a code after a conversion of its unit
FACTORS = {"speed": (1.0, 30.0 / math.pi), "torque": (1.0, 1e-3, 1e3)}
"""From SI to the units in which a code may have been written."""
FAR = 0.5  # relative change of a reading above which it may be a code
TORQUE, SPEED = 2.0, 1.2  # multiples of the limits of a scene that a reading may reach
COLDEST, HOTTEST = 200.0, 475.0  # [K] of oil
ZERO_CELSIUS = 273.15  # [K]


class Range(NamedTuple):
    """Values that a channel can have, in SI."""

    low: float
    high: float
    limited_by: str
    """What limits them."""


def ranges_of(train: FollowedTrain) -> dict[str, Range]:
    """Values that readings of a scene can have, by channel.

    Args:
        train: gear train of the scene.
    """
    speed, torque = SPEED * train.speed_limit, TORQUE * train.torque_limit
    ratio = abs(train.ratio)
    by_speed = f"{SPEED:g} times drive.speed_limit"
    by_torque = f"{TORQUE:g} times drive.torque_limit"
    return {
        "input_speed": Range(-speed, speed, by_speed),
        "output_speed": Range(-speed * ratio, speed * ratio, f"{by_speed} at the output"),
        "input_torque": Range(-torque, torque, by_torque),
        "output_torque": Range(-torque / ratio, torque / ratio, f"{by_torque} at the output"),
        OIL: Range(COLDEST, HOTTEST, "the range of an oil"),
    }


def beyond(values: Array, allowed: Range) -> Mask:
    """Which readings are outside of a range; false where one is missing.

    Args:
        values: readings in SI, any shape.
        allowed: the range.
    """
    return np.asarray((values < allowed.low) | (values > allowed.high))


def equals_code(channel: str, values: Array) -> Mask:
    """Which readings equal a code in one of the usual units of a channel.

    Args:
        channel: name of the channel.
        values: readings in SI, any shape.
    """
    if channel == OIL:
        written = [values, values - ZERO_CELSIUS]
    else:
        written = [values * factor for factor in FACTORS[channel.split("_")[1]]]
    found = np.zeros(np.shape(values), dtype=bool)
    for one in written:
        whole = np.rint(one)
        code = CODES[np.minimum(np.searchsorted(CODES, whole), len(CODES) - 1)]
        found |= (whole == code) & (np.abs(one - whole) <= EXACT * np.abs(code))
    return found


def leaps(values: Array, usual: Array) -> Mask:
    """Which readings are far from the usual ones: a channel that passes a code's value is not.

    Args:
        values: readings, any shape.
        usual: the last reading before each that equals no code.
    """
    return ~(np.abs(values - usual) <= FAR * np.abs(usual))
