"""Amplitudes of vibration at mesh orders and at their sidebands, over one hunting period.

A fault of one tooth modulates the meshes once per turn of its gear: its sidebands are 1/Z mesh
orders apart (McFadden 1986, J. Vib. Acoust. 108(2), 165-170). Sidebands that two gears share
identify neither of them, so only those that one gear alone has are used.

Amplitudes are those of a Hann window over the angle of the input, the integral of the measured
speed. The gain error of the speed sensor would shift the lines, so the speed is scaled, by less
than `STRETCH`, to the maximum of the first mesh order. The phases of equally spaced planets may
cancel that order in the sum of their meshes (Parker 2000, J. Sound Vib. 236(4), 561-573): then the
next order that does not vanish is used. If this maximum, searched up to half of the way to the next
sideband of the first order, is farther away, the lines are not where the speed places them.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from .train import FollowedTrain

Array = NDArray[np.float64]
Waves = NDArray[np.complex128]

HARMONICS = 3  # of the mesh frequency
SIDEBANDS = 2  # on each side of a harmonic, for each gear
STRETCH = 2e-3  # relative error that the measured speed must not reach
STEP = 2e-4  # between trial values of the scale of the speed
VANISHED = 0.01  # of the strongest mesh order, below which one may be noise only
TURN = 0.25  # [rad] phase of the farthest line in a block; see `_near_harmonics`


class Line(NamedTuple):
    """A line of a spectrum over the mesh cycles."""

    mesh: int
    """Harmonic of the mesh."""
    side: int
    """Number of the sideband, negative below the harmonic."""
    teeth: int
    """Number of teeth of the gear whose rotation separates the sidebands."""

    @property
    def order(self) -> float:
        """Frequency of the line over the mesh frequency."""
        return self.mesh + self.offset

    @property
    def offset(self) -> float:
        """Its distance from the harmonic, in mesh orders."""
        return self.side / self.teeth


class Pattern(NamedTuple):
    """Lines that grow together."""

    name: str
    lines: tuple[Line, ...]
    causes: tuple[str, ...]


class PatternAmplitudes:
    """Amplitudes of the patterns of lines of a gear train.

    Args:
        train: gear train, which defines the mesh orders.
    """

    def __init__(self, train: FollowedTrain) -> None:
        self.patterns = tuple(_patterns(train))
        self._cycles = abs(float(train.cycles))  # mesh orders per turn of the input
        self._beside = 0.5 / max(train.teeth.values())  # in mesh orders: between two sidebands
        steps = round(max(self._beside, STRETCH) / STEP)
        self._stretches = 1.0 + STEP * np.arange(-steps, steps + 1)
        offsets = [abs(line.offset) for pattern in self.patterns for line in pattern.lines]
        self._widest = (1.0 + STRETCH) * (max(offsets) + self._beside) + HARMONICS * STRETCH

    def of(self, angle: Array, values: Array, highest: float) -> Array | None:
        """Root mean square of the amplitudes of every pattern.

        Args:
            angle: measured angle of the input at each sample [rad], (n,).
            values: samples in the units of the channels, (n, channels).
            highest: mesh order below which the sample rate resolves a line.

        Returns:
            Amplitudes of the lines, and beside the sidebands, (2, channels, patterns); NaN for a
            pattern without a line below `highest`. None if the speed is not that of the lines.
        """
        if highest <= 1.0:
            return np.full((2, values.shape[1], len(self.patterns)), np.nan)
        mesh = angle * self._cycles
        window = np.hanning(len(mesh) + 2)[1:-1]
        weighted = (values - values.mean(axis=0)) * (2.0 * window / window.sum())[:, None]
        near = _near_harmonics(mesh, weighted, self._widest)
        stretch = self._stretch([near[mesh] for mesh in near if mesh < highest])
        if abs(stretch - 1.0) > STRETCH - 0.5 * STEP:
            return None

        def mean_square(lines: Sequence[tuple[int, float]]) -> Array:
            """Mean of squares at offsets from harmonics, in mesh orders of the scaled speed."""
            powers = [
                np.abs(near[mesh].at(mesh * (stretch - 1.0) + stretch * offset)) ** 2
                for mesh, offset in lines
            ]
            return np.mean(powers, axis=0) if powers else np.full(values.shape[1], np.nan)

        squares, floors = [], []
        for pattern in self.patterns:
            lines = [line for line in pattern.lines if line.order < highest]
            squares.append(mean_square([(line.mesh, line.offset) for line in lines]))
            floors.append(
                mean_square(
                    [
                        (line.mesh, line.offset + beside)
                        for line in lines
                        if line.side
                        for beside in (-self._beside, self._beside)
                    ]
                )
            )
        return np.sqrt(np.array([np.stack(squares, axis=1), np.stack(floors, axis=1)]))

    def _stretch(self, near: Sequence[_Near]) -> float:
        """Scale of the speed at which the first mesh order that does not vanish is strongest."""
        strengths = np.array(
            [
                [float(np.sum(np.abs(one.at(mesh * (trial - 1.0))))) for trial in self._stretches]
                for mesh, one in enumerate(near, 1)
            ]
        )
        highest = strengths.max(axis=1)
        first = strengths[int(np.argmax(highest >= VANISHED * highest.max()))]
        return float(self._stretches[int(np.argmax(first))])


class _Near(NamedTuple):
    """Samples near a harmonic: shifted to frequency zero, filtered, at a lower rate."""

    mesh: Array
    """Angles times the mesh order [rad], (m,)."""
    values: Waves
    """Filtered samples, (m, channels)."""

    def at(self, offset: float) -> Waves:
        """Amplitudes at an offset from the harmonic, in mesh orders, (channels,)."""
        return np.exp(-1j * offset * self.mesh) @ self.values


def _near_harmonics(mesh: Array, weighted: Array, widest: float) -> dict[int, _Near]:
    """Samples near every harmonic, for offsets of up to `widest` mesh orders.

    Triangular weights over two blocks reduce the amplitude of a line at `widest` by
    1 - sinc(TURN/2)^2, or 0.5 %, and what is folded there to (TURN/2 pi)^2, or 0.16 %.
    """
    step = abs(mesh[-1] - mesh[0]) / (len(mesh) - 1)  # [rad]
    each = max(1, int(TURN / (widest * step)))
    blocks = len(mesh) // each
    centres = mesh[: blocks * each].reshape(blocks, each).mean(axis=1)
    middles = 0.5 * (centres[1:] + centres[:-1])  # of two blocks, over which weights rise and fall
    rise = (np.arange(each) + 0.5) / each
    wave = np.exp(-1j * mesh[: blocks * each])[:, None]
    shifted, near = weighted[: blocks * each].astype(complex), {}
    for harmonic in range(1, HARMONICS + 1):
        shifted = wave * shifted
        parts = shifted.reshape(blocks, each, -1)
        rising, falling = (np.einsum("e,bec->bc", part, parts) for part in (rise, 1.0 - rise))
        near[harmonic] = _Near(middles, rising[:-1] + falling[1:])
    return near


def _patterns(train: FollowedTrain) -> Iterator[Pattern]:
    """Mesh harmonics, and the sidebands of every gear."""
    meshes = range(1, HARMONICS + 1)
    for mesh in meshes:
        causes = ("wear of all teeth", "a change of the meshes", "the path to the sensor")
        yield Pattern(f"mesh harmonic {mesh}", (Line(mesh, 0, 1),), causes)
    kinds = {name.partition("_")[0]: count for name, count in train.teeth.items()}
    for gear, count in kinds.items():
        others = {other: teeth for other, teeth in kinds.items() if other != gear}
        orders = range(1, count)
        unshared = [n for n in orders if all(n * teeth % count for teeth in others.values())]
        sharing_gears = (
            [] if unshared else [other for other, teeth in others.items() if teeth % count == 0]
        )
        lines = tuple(
            Line(mesh, sign * n, count)
            for mesh in meshes
            for n in (unshared or orders)[:SIDEBANDS]
            for sign in (-1, 1)
        )
        teeth_of = tuple(f"a tooth of the {member}" for member in (gear, *sharing_gears))
        yield Pattern(f"sidebands of the {gear}", lines, (*teeth_of, "a runout"))
