"""Average of the spectra of several records, by power.

Noise is not lower in it, but more even, so that lower lines stand out (Welch 1967, IEEE Trans.
Audio Electroacoust. 15, 70-73).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from ..signals.signal import Signal
from .mesh_spectrum import NEAR, MeshSpectrum, frequency_spectrum_of, order_spectra_of

SAME = 0.1  # [bins] by which the axes of two spectra may differ at their ends


def averaged_spectrum(
    signals: Sequence[Signal], sun_teeth: int | None, by_order: bool
) -> MeshSpectrum:
    """Average of the spectra of signals, of their first parts as long as the shortest one.

    Args:
        signals: uniformly spaced.
        sun_teeth: number of teeth of the sun; None if it is unknown.
        by_order: whether over orders, otherwise over frequency.

    Raises:
        ValueError: see `order_spectrum_of`; or over frequency, sample rates differ.
    """
    if by_order:
        return averaged(order_spectra_of(signals, sun_teeth))
    count = min(len(one.samples) for one in signals)
    rates = [one.sample_rate for one in signals]
    if max(rates) - min(rates) > 2.0 * SAME * max(rates) / count:
        raise ValueError(
            f"average: sample rates from {min(rates):.9g} to {max(rates):.9g} Hz: must be equal; "
            "average over orders with --order, or give --sample-rate"
        )
    parts = [
        replace(one, samples=one.samples[:count], time=one.time[:count], angle=one.angle[:count])
        for one in signals
    ]
    return averaged([frequency_spectrum_of(one, sun_teeth) for one in parts])


def averaged(spectra: Sequence[MeshSpectrum]) -> MeshSpectrum:
    """The average of spectra with the same axis.

    Args:
        spectra: at least one.

    Returns:
        Root of the mean square of the amplitudes; mesh frequency and sample rate are means.
    """
    first = spectra[0]
    power = np.mean([one.amplitude**2 for one in spectra], axis=0)
    places = [one.mesh for one in spectra if one.mesh is not None]
    band = first.band._replace(high=min(one.band.high for one in spectra))
    return replace(
        first,
        amplitude=np.sqrt(power),
        mesh=float(np.mean(places)) if len(places) == len(spectra) else None,
        sample_rate=float(np.mean([one.sample_rate for one in spectra])),
        edge=max(one.edge for one in spectra),
        error=max(one.error for one in spectra),
        band=band,
        averages=len(spectra),
    )


def spread_of_mesh(signals: Sequence[Signal], resolution: float, sun_teeth: int) -> str | None:
    """A remark if mesh frequencies differ by more than lines are wide; None otherwise.

    Args:
        signals: whose spectra over frequency are averaged.
        resolution: of the spectrum [Hz].
        sun_teeth: number of teeth of the sun.
    """
    places = [sun_teeth * abs(one.speed) / math.tau for one in signals]
    if max(places) - min(places) <= NEAR * resolution:
        return None
    return (
        f"the mesh frequencies of the files run from {min(places):.6g} to {max(places):.6g} Hz: "
        "their lines are spread in the average; use --order"
    )
