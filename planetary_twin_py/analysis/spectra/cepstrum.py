"""Cepstrum, and pre-whitening by it.

The real cepstrum of a signal with an echo of the share a after the time t has lines a/2, -a^2/4,
a^3/6 at t, 2 t, 3 t (Bogert, Healy and Tukey 1963; Randall 2017, Mech. Syst. Signal Process. 97,
3-19). Without its cepstrum except at zero, a signal has the same magnitude at all frequencies:
tones and resonances no longer hide impacts (Borghesani et al. 2013, Mech. Syst. Signal Process. 36,
370-384).
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .spectrum import checked

Array = NDArray[np.float64]
ROUNDING = 32 * float(np.finfo(np.float64).eps)  # of samples computed in several operations


def real_cepstrum(samples: ArrayLike) -> Array:
    """Real cepstrum: the inverse transform of the logarithm of the magnitude (Bogert et al. 1963).

    Args:
        samples: the signal in any unit, (n,), n at least 8.

    Returns:
        The cepstrum over quefrency, in steps of the sample period, (n,).

    Raises:
        ValueError: there are too few samples, one is not finite, there are several channels, or
            the spectrum is zero somewhere, where the logarithm is not defined.
    """
    spectrum, count = _spectrum(samples)
    return np.fft.irfft(np.log(np.abs(spectrum)), count)


def pre_whitened(samples: ArrayLike) -> Array:
    """Signal with the same phases and the magnitude 1 at all frequencies (Borghesani et al. 2013).

    Args:
        samples: the signal in any unit, (n,), n at least 8.

    Returns:
        The signal without unit, (n,); n times its mean square is 1.

    Raises:
        ValueError: there are too few samples, one is not finite, there are several channels, or
            the spectrum is zero somewhere, where the phase is not defined.
    """
    spectrum, count = _spectrum(samples)
    return np.fft.irfft(spectrum / np.abs(spectrum), count)


def _spectrum(samples: ArrayLike) -> tuple[NDArray[np.complex128], int]:
    values = checked(samples)
    if values.ndim != 1:
        raise ValueError(f"samples: shape {values.shape}: must be one channel, (n,)")
    spectrum, count = np.fft.rfft(values), len(values)
    # Error of a fast transform (Higham 2002, Accuracy and Stability, theorem 24.2), in each bin.
    relative = ROUNDING * math.log2(count)
    rounding = np.full(len(spectrum), relative * float(np.linalg.norm(values)))
    rounding[0] = 0.0  # a mean that was subtracted is one bin of many
    if zero := np.flatnonzero(np.abs(spectrum) <= rounding).tolist():
        raise ValueError(
            f"samples: their spectrum is zero in bin {zero[0]}, but for rounding: nothing is "
            "defined; add the noise of a sensor"
        )
    return spectrum, count
