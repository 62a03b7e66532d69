"""Filters between what a sensor senses and its samples.

The poles of a path and of a sensor are a recursion, whose poles are theirs exactly. The rest of
their response is smooth, and is one finite impulse response together with the filter that stops
aliases. Both compute each sample in the same way, whatever is given at once.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.signal import firwin, kaiserord, lfilter, upfirdn

from ..scene.sensors.accelerometer import STOPPED
from .mode import Mode

PASSED = 0.4  # of the sample rate: up to there the filter is flat
ATTENUATION = 80.0  # [dB] of what it stops
DECAYS = 10.0  # time constants after which 5e-5 of a start are left
BESIDE = 0.4  # of the rate of the signals: poles below are a recursion, those above are smooth
MARGIN = 0.5  # of the length of the filter, by which a smooth response extends it

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]


class Response(NamedTuple):
    """How a path or a sensor responds."""

    at: Callable[[Array], Complex]
    """Complex response at angular frequencies [rad/s], (n,)."""
    modes: tuple[Mode, ...] = ()
    """Its poles."""
    spread: float = 0.0
    """Time before and after an impulse for which it lasts, poles aside [s]."""

    def then(self, other: Response) -> Response:
        """Response of this one and another one behind it."""
        return Response(
            lambda omega: np.multiply(self.at(omega), other.at(omega)),
            self.modes + other.modes,
            self.spread + other.spread,
        )


UNCHANGED = Response(lambda omega: np.ones(len(omega), dtype=complex))
DERIVATIVE = Response(lambda omega: np.asarray(1j * omega, dtype=np.complex128))
SECOND_DERIVATIVE = Response(lambda omega: np.asarray(-(omega**2), dtype=np.complex128))


def low_pass(ratio: int) -> Array:
    """Linear-phase filter for a sensor that takes one of `ratio` samples.

    Flat within 0.1 % up to 0.4 of the rate of the sensor, 80 dB down from 0.6 on (Kaiser's window;
    Oppenheim and Schafer 2010, section 7.6).

    Args:
        ratio: rate of the signal over that of the sensor.

    Returns:
        Coefficients, an odd number of them.
    """
    width = 2.0 * (STOPPED - PASSED) / ratio  # of half the rate of the signal
    count, beta = kaiserord(ATTENUATION, width)
    return np.asarray(firwin(count | 1, (PASSED + STOPPED) / ratio, window=("kaiser", beta)))


class Decimator:
    """Filters a signal and takes one of `ratio` samples, as its samples arrive.

    Args:
        response: of path and sensor.
        rate: of the signal [Hz].
        ratio: `rate` over the rate of the sensor.
        first: number of the first sample of the signal.
    """

    def __init__(self, response: Response, rate: float, ratio: int, first: int) -> None:
        modes = [mode for mode in response.modes if mode.frequency < math.tau * BESIDE * rate]
        self._poles = [_poles(mode, rate) for mode in modes]
        self._states = [np.zeros(2) for _ in modes]
        self._taps, self._ahead = _taps(low_pass(ratio), response, self._poles, rate, ratio)
        self._ratio = ratio
        settling = math.ceil(DECAYS * sum(mode.decay for mode in modes) * rate)
        complete = first + settling + len(self._taps) - 1 - self._ahead
        self.next = -(-complete // ratio)
        """Number of the next sample of the sensor."""
        self._past, self._first = np.empty(0), first

    def take(self, signal: Array) -> Array:
        """Samples of the sensor that consecutive samples of the signal complete.

        Args:
            signal: the samples that follow those before, (n,).

        Returns:
            Samples from number `next` on, as it was before the call.
        """
        for n, poles in enumerate(self._poles):
            signal, self._states[n] = lfilter([1.0], poles, signal, zi=self._states[n])
        past, taps, ratio = np.concatenate([self._past, signal]), self._taps, self._ratio
        begin = self.next * ratio - (len(taps) - 1 - self._ahead) - self._first  # in `past`
        count = max((len(past) - begin - len(taps)) // ratio + 1, 0)
        values = np.empty(0)
        if count:
            span = past[begin : begin + (count - 1) * ratio + len(taps)]
            before = (len(taps) - 1) // ratio  # outputs that would need samples before the span
            values = upfirdn(taps, span, 1, ratio)[before : before + count]
        unused = min(begin + count * ratio, len(past))
        if unused > 0:
            past, self._first = past[unused:], self._first + unused
        self._past, self.next = past, self.next + count
        return values


def _poles(mode: Mode, rate: float) -> Array:
    """Denominator of a recursion with the poles of a mode, (3,)."""
    decay = math.exp(-mode.damping_ratio * mode.frequency / rate)
    turn = mode.frequency * math.sqrt(1.0 - mode.damping_ratio**2) / rate
    return np.array([1.0, -2.0 * decay * math.cos(turn), decay**2])


def _taps(
    stop: Array, response: Response, poles: Sequence[Array], rate: float, ratio: int
) -> tuple[Array, int]:
    """Impulse response of all but the poles, and the number of its coefficients ahead of time 0.

    The number of coefficients less one is a multiple of `ratio`.
    """
    margin = math.ceil(MARGIN * len(stop) + response.spread * rate)
    ahead = len(stop) // 2 + margin
    count = 2 * ahead + 1
    count += -(count - 1) % ratio
    size = 1 << (2 * count - 1).bit_length()
    omega: Array = np.asarray(math.tau * rate * np.fft.rfftfreq(size), dtype=np.float64)
    spectrum = np.fft.rfft(np.roll(np.pad(stop, (0, size - len(stop))), -(len(stop) // 2)))
    spectrum = spectrum * response.at(omega)
    for denominator in poles:
        spectrum = spectrum * np.fft.rfft(denominator, size)
    return np.roll(np.fft.irfft(spectrum, size), ahead)[:count], ahead
