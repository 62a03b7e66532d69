"""Band around a mesh harmonic, with its amplitude and phase.

A fault of a tooth changes the amplitude and the phase of the meshing while it is in mesh (McFadden
1986, J. Vib. Acoust. 108, 165-170).
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .gear_signals import one_turn, tooth_numbers

Array = NDArray[np.float64]
ROUNDING = 1e-12  # of the average, below which an amplitude is none


class MeshBand(NamedTuple):
    """A band-pass signal over one turn of a gear."""

    signal: Array
    """The band, in the unit of the average, (points,)."""
    amplitude: Array
    """Amplitude of the meshing (envelope), in the same unit, (points,)."""
    phase: Array
    """Phase of the meshing against an even one, with mean 0 [rad], (points,); NaN without a line
    in the band."""
    orders: tuple[int, int]
    """Lowest and highest order of the band [cycles per turn]."""


def mesh_band(
    average: ArrayLike, teeth: int, harmonic: int = 1, half_width: int | None = None
) -> MeshBand:
    """Amplitude and phase of a mesh harmonic over one turn (McFadden 1986).

    Args:
        average: over one turn of the gear, in any unit, (points,), points at least 8.
        teeth: of the gear.
        harmonic: number of the mesh harmonic.
        half_width: orders on each side, below half the tooth number; default: the largest.

    Returns:
        The band, its amplitude and phase, (points,) each.

    Raises:
        ValueError: there are too few points or one is not finite, the band is above half the
            points, or wider than a tooth number.
    """
    values, (count,) = one_turn(average), tooth_numbers(teeth)
    widest = (count - 1) // 2
    half = widest if half_width is None else half_width
    if not 1 <= half <= widest or harmonic < 1:
        raise ValueError(
            f"half_width = {half}, harmonic = {harmonic}: must be within 1 and {widest}, and 1 or "
            "more"
        )
    centre = harmonic * count
    if centre + half >= len(values) / 2:
        raise ValueError(
            f"average: {len(values)} points: must be more than {2 * (centre + half)}, twice the "
            "highest order of the band"
        )
    spectrum = np.fft.fft(values)
    inside = slice(centre - half, centre + half + 1)
    band = np.zeros_like(spectrum)
    band[inside] = 2.0 * spectrum[inside]
    analytic = np.fft.ifft(band)
    even = np.exp(-2j * np.pi * centre * np.arange(len(values)) / len(values))
    turned, amplitude = np.unwrap(np.angle(analytic * even)), np.abs(analytic)
    phase = turned - turned.mean()
    if amplitude.max() <= ROUNDING * np.abs(values).max():
        phase = np.full_like(phase, np.nan)
    return MeshBand(analytic.real, amplitude, phase, (centre - half, centre + half))
