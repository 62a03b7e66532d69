"""Converts samples to the unit that was measured: by full scale of a recorder, by sensitivity."""

from __future__ import annotations

import re
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...units.conversion import column_to_si, is_number
from .wav_file import OF_FULL_SCALE

Array = NDArray[np.float64]
_GIVEN = re.compile(r"\s*([-+]?[\d.]+(?:[eE][-+]?\d+)?)\s*([^\s\d.].*?)\s*")


class Scaling(NamedTuple):
    """What samples mean."""

    full_scale: str | None = None
    """Largest value of a recorder, such as "10 V" or "50 g"."""
    sensitivity: str | None = None
    """Of a sensor, such as "100 mV/g" or "10.2 mV/(m/s^2)"."""


def scaled(values: Array, unit: str | None, scaling: Scaling) -> tuple[Array, str | None]:
    """Samples, and their unit, after full scale and sensitivity.

    Args:
        values: samples, (n,).
        unit: their unit; None if it is not known.
        scaling: what they mean.

    Raises:
        ValueError: a text is not a number with a unit, or does not fit the unit of the samples.
    """
    if scaling.full_scale is not None:
        number, of_value = _read("full_scale", scaling.full_scale)
        if unit != OF_FULL_SCALE:
            raise ValueError(
                f"full_scale = {scaling.full_scale!r}: the samples are in [{unit or '-'}], not "
                "shares of full scale as in a WAV file"
            )
        values, unit = number * values, of_value
    if scaling.sensitivity is not None:
        number, ratio = _read("sensitivity", scaling.sensitivity)
        signal, slash, quantity = ratio.partition("/")
        if not slash:
            raise ValueError(
                f"sensitivity = {scaling.sensitivity!r}: must be such as 100 mV/g, or 10 mV/(m/s^2)"
            )
        if unit is None or unit == OF_FULL_SCALE:
            advice = "--full-scale '10 V'" if unit else "--column 'NAME [V]'"
            raise ValueError(
                f"sensitivity = {scaling.sensitivity!r}: the samples have no unit; state it by "
                f"{advice}"
            )
        try:
            values = column_to_si(values, unit, signal.strip()) / number
        except ValueError as reason:
            raise ValueError(f"sensitivity = {scaling.sensitivity!r}: {reason}") from None
        unit = quantity.strip().removeprefix("(").removesuffix(")")
    return values, unit


def _read(name: str, text: str) -> tuple[float, str]:
    parts = _GIVEN.fullmatch(text)
    if parts is None or not is_number(parts[1]) or not float(parts[1]) != 0.0:
        raise ValueError(f"{name} = {text!r}: must be a number, not 0, with a unit")
    return float(parts[1]), parts[2]
