"""A perceptually uniform colour map: lightness increases evenly from violet to pale yellow.

It is defined in Oklab (Ottosson 2020, A perceptual color space for image processing).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

_LIGHTNESS = (0.32, 0.97)
_HUE = (-70.0, 105.0)  # [deg] violet through red to yellow
_CHROMA = 0.17  # reduced for colours outside sRGB
_LEVELS = 256

# Oklab to the cube roots of cone responses, and these cubed to linear sRGB (Ottosson 2020).
_TO_ROOTS = np.array(
    [
        [1.0, 0.3963377774, 0.2158037573],
        [1.0, -0.1055613458, -0.0638541728],
        [1.0, -0.0894841775, -1.2914855480],
    ]
)
_TO_LINEAR = np.array(
    [
        [4.0767416621, -3.3077115913, 0.2309699292],
        [-1.2684380046, 2.6097574011, -0.3413193965],
        [-0.0041960863, -0.7034186147, 1.7076147010],
    ]
)


def shade(level: NDArray[np.float64]) -> NDArray[np.uint8]:
    """Colours (..., 3) of levels (...) from 0, dark, to 1, bright; clipped outside.

    Args:
        level: levels, any shape.
    """
    place = np.rint((_LEVELS - 1) * np.clip(level, 0.0, 1.0)).astype(np.intp)
    return _TABLE[place]


def _colour(share: float) -> NDArray[np.uint8]:
    """The colour at a fraction of the map, with the largest chroma within sRGB."""
    lightness = np.full(100, _LIGHTNESS[0] + share * (_LIGHTNESS[1] - _LIGHTNESS[0]))
    hue = np.radians(_HUE[0] + share * (_HUE[1] - _HUE[0]))
    chroma = np.linspace(_CHROMA, 0.0, len(lightness))
    lab = np.array([lightness, chroma * np.cos(hue), chroma * np.sin(hue)])
    linear = _TO_LINEAR @ (_TO_ROOTS @ lab) ** 3
    in_gamut = (linear.min(axis=0) >= 0.0) & (linear.max(axis=0) <= 1.0)
    strongest = linear[:, in_gamut.argmax()]
    curve = np.where(
        strongest <= 0.0031308, 12.92 * strongest, 1.055 * strongest ** (1.0 / 2.4) - 0.055
    )
    return np.rint(255.0 * curve).astype(np.uint8)  # sRGB, IEC 61966-2-1


_TABLE = np.array([_colour(share) for share in np.linspace(0.0, 1.0, _LEVELS)])
