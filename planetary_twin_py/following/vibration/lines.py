"""Amplitudes of vibration at mesh orders and at their sidebands, over one hunting period.

Amplitudes are those of a Hann window over the angle of the input, the integral of the measured
speed. The gain error of the speed sensor would shift the lines, so the speed is scaled, by less
than `STRETCH`, to the maximum of the first mesh order. The phases of equally spaced planets may
cancel that order in the sum of their meshes (Parker 2000, J. Sound Vib. 236(4), 561-573): then the
next order that does not vanish is used. If this maximum, searched up to half of the way to the next
sideband of the first order, is farther away, the lines are not where the speed places them.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..train import FollowedTrain
from .patterns import HARMONICS, INDICATORS, Line, patterns_of

Array = NDArray[np.float64]
Waves = NDArray[np.complex128]

STRETCH = 2e-3  # relative error that the measured speed must not reach
STEP = 2e-4  # between trial values of the scale of the speed
VANISHED = 0.01  # of the strongest mesh order, below which one may be noise only
TURN = 0.25  # [rad] phase of the farthest line in a block; see `_decimated`


class PatternAmplitudes:
    """Amplitudes of the patterns of lines of a gear train."""

    def __init__(self, train: FollowedTrain, rolling: tuple[int, Fraction] | None = None) -> None:
        self.patterns = patterns_of(train, rolling)
        self.over_torque = np.array([pattern.name != "kurtosis" for pattern in self.patterns])
        """Whether an amplitude grows with the torque, (patterns,)."""
        self._cycles = abs(float(train.cycles))  # mesh orders per turn of the input
        self._beside = 0.5 / max(train.teeth.values())  # in mesh orders: between two sidebands
        steps = round(max(self._beside, STRETCH) / STEP)
        self._stretches = np.linspace(1.0 - steps * STEP, 1.0 + steps * STEP, 2 * steps + 1)
        self._scaled = HARMONICS * max(self._beside, STRETCH)  # offsets of a search for the scale
        lines = [line for pattern in self.patterns for line in pattern.lines]
        self._widest = _widest([line for line in lines if line.mesh])
        self._widest_squared = _widest([line for line in lines if not line.mesh])

    def of(self, angle: Array, values: Array, highest: float) -> Array | None:
        """Root mean square of the amplitudes of every pattern, or its indicator.

        A line of the squared samples counts as one of an amplitude whose square it has. The samples
        (n, channels) belong to measured angles of the input [rad], (n,). Lines are below the mesh
        order `highest`. Results are (2, channels, patterns): of the lines, and beside the
        sidebands; NaN for a pattern without a line; None if the speed is not that of the lines.
        """
        if highest <= 1.0:
            return np.full((2, values.shape[1], len(self.patterns)), np.nan)
        mesh = angle * self._cycles
        window = np.hanning(len(mesh) + 2)[1:-1]
        window *= 2.0 / window.sum()
        centred = values - values.mean(axis=0)
        near, close = _near_harmonics(mesh, centred * window[:, None], (self._widest, self._scaled))
        stretch = self._stretch([one for mesh, one in enumerate(close, 1) if mesh < highest])
        squares = centred**2
        power = squares.mean(axis=0)
        weighted = ((squares - power) * window[:, None]).astype(complex)
        near[0] = _decimated(mesh, weighted, self._widest_squared)
        if abs(stretch - 1.0) > STRETCH - 0.5 * STEP:
            return None
        at_scale = [near[mesh].scaled(stretch, mesh) for mesh in range(HARMONICS + 1)]
        # Harmonics have the same offsets, so each wave is computed once.
        wave = lru_cache(None)(lambda squared, offset: at_scale[0 if squared else 1].wave(offset))

        def mean_square(places: Sequence[tuple[int, float]]) -> Array:
            """Mean of squares at offsets from harmonics, at the scaled speed."""
            powers = [
                np.abs(wave(not mesh, offset) @ at_scale[mesh].values) ** (2 if mesh else 1)
                for mesh, offset in places
            ]
            return np.mean(powers, axis=0) if powers else np.full(values.shape[1], np.nan)

        found, floors = [], []
        for pattern in self.patterns:
            lines = [line for line in pattern.lines if line.order < highest]
            found.append(mean_square([(line.mesh, line.offset) for line in lines]))
            sides = [(line.mesh, offset) for line in lines for offset in line.beside]
            floors.append(mean_square(sides))
        fourth = (squares**2).mean(axis=0) / np.where(power > 0.0, power, np.inf) ** 2
        found[-len(INDICATORS) :] = [power, fourth**2]  # their roots are rms and kurtosis
        return np.sqrt(np.array([np.stack(found, axis=1), np.stack(floors, axis=1)]))

    def _stretch(self, near: Sequence[_Near]) -> float:
        """Scale of the speed at which the first mesh order that does not vanish is strongest."""
        strengths = np.array(
            [
                np.abs(
                    np.sum(
                        one.wave(mesh * (self._stretches - 1.0))[:, :, None] * one.values, axis=1
                    )
                ).sum(axis=1)
                for mesh, one in enumerate(near, 1)
            ]
        )
        highest = strengths.max(axis=1)
        first = strengths[int(np.argmax(highest >= VANISHED * highest.max()))]
        return float(self._stretches[int(np.argmax(first))])


def _widest(lines: Sequence[Line]) -> float:
    """Largest distance from its harmonic at which an amplitude is computed, in mesh orders."""
    reach = max(abs(offset) for line in lines for offset in (line.offset, *line.beside))
    return (1.0 + STRETCH) * reach + HARMONICS * STRETCH


class _Near(NamedTuple):
    """Samples near a harmonic: shifted to frequency zero, filtered, at a lower rate."""

    mesh: Array
    """Angles times the mesh order [rad], (m,)."""
    values: Waves
    """Filtered samples, (m, channels)."""

    def wave(self, offset: float | Array) -> Waves:
        """Wave whose product with the samples is their amplitude at an offset from the harmonic, in
        mesh orders, (m,); at several, (offsets, m)."""
        return np.exp(-1j * np.multiply.outer(offset, self.mesh))

    def scaled(self, stretch: float, harmonic: int) -> _Near:
        """The same samples where a harmonic is by angles that are `stretch` times as large."""
        shift = self.wave(harmonic * (stretch - 1.0))[:, None]
        return _Near(stretch * self.mesh, shift * self.values)


def _near_harmonics(
    mesh: Array, weighted: Array, reaches: tuple[float, float]
) -> tuple[dict[int, _Near], list[_Near]]:
    """Samples near every harmonic, for offsets of up to each of two reaches in mesh orders."""
    wave = np.exp(-1j * mesh)[:, None]
    shifted, near, close = weighted.astype(complex), {}, []
    for harmonic in range(1, HARMONICS + 1):
        shifted = wave * shifted
        near[harmonic] = _decimated(mesh, shifted, reaches[0])
        close.append(_decimated(mesh, shifted, reaches[1]))
    return near, close


def _decimated(mesh: Array, shifted: Waves, widest: float) -> _Near:
    """Samples near frequency zero, for offsets of up to `widest` mesh orders.

    Triangular weights over two blocks reduce the amplitude of a line at `widest` by
    1 - sinc(TURN/2)^2, or 0.5 %, and what is folded there to (TURN/2 pi)^2, or 0.16 %.
    """
    step = abs(mesh[-1] - mesh[0]) / (len(mesh) - 1)  # [rad]
    each = max(1, int(TURN / (widest * step)))
    blocks = len(mesh) // each
    centres = mesh[: blocks * each].reshape(blocks, each).mean(axis=1)
    middles = 0.5 * (centres[1:] + centres[:-1])  # of two blocks, over which weights rise and fall
    rise = (np.arange(each) + 0.5) / each
    parts = shifted[: blocks * each].reshape(blocks, each, -1)
    rising, falling = (np.einsum("e,bec->bc", part, parts) for part in (rise, 1.0 - rise))
    return _Near(middles, rising[:-1] + falling[1:])
