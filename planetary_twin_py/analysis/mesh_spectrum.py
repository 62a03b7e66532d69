"""The spectrum of one mesh, by frequency or by order, and which of its lines are of the meshing."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Self

import numpy as np
from numpy.typing import NDArray

from .aliases import CARRIED, edge_amplitude, folded_harmonic
from .band import Band
from .orders import order_spectrum
from .signals import Signal
from .spectrum import Array, Line, amplitude_spectrum, strongest_lines

NEAR = 1.0  # [bins] from a harmonic: such a line is called one
HIGHEST_ALIAS = 2.0  # over what stands next to half the sample rate


@dataclass(frozen=True)
class MeshSpectrum:
    """`axis` [Hz or cycles per turn] and peak `amplitude` in SI (bins,).

    `mesh` is where the first harmonic of the meshing lies on the axis; None if unknown. `band` is
    the part of the axis that is looked at. `sample_rate` is that of the samples in the unit of the
    axis, `edge` what their spectrum over frequency has next to half of it, see `aliases`.
    """

    axis: Array
    amplitude: Array
    mesh: float | None
    band: Band
    sample_rate: float
    edge: float

    @property
    def alias_share(self) -> float:
        """Height of aliases over that of the highest line, about."""
        highest = float(self.amplitude[1:].max())
        return self.edge / highest if highest > 0.0 else 0.0

    def within(self, band: Band) -> Self:
        """The same, looked at in `band`; raises `ValueError` where no bin lies in it."""
        narrowed = replace(self, band=Band(band.low, min(band.high, self.band.high)))
        if not narrowed.seen.any():
            raise ValueError(
                f"band = '{band.low:g}:{band.high:g}': nothing there: the spectrum has a value "
                f"each {self.axis[1]:.4g} up to {self.axis[-1]:g}"
            )
        return narrowed

    @property
    def seen(self) -> NDArray[np.bool_]:
        """Which bins lie in the band (bins,)."""
        return np.asarray((self.axis >= self.band.low) & (self.axis <= self.band.high))

    def lines(self, count: int) -> list[Line]:
        """The highest in the band, see `strongest_lines`."""
        # All are sought first: where a band begins or ends in a slope is no peak.
        found = strongest_lines(self.axis, self.amplitude, len(self.axis))
        return [line for line in found if self.band.low <= line.place <= self.band.high][:count]

    def in_mesh_orders(self, place: float) -> float | None:
        """`place` on the axis over the first harmonic of the meshing."""
        return None if self.mesh is None else place / self.mesh

    def harmonic(self, place: float) -> int | None:
        """Which harmonic of the meshing the line at `place` is, if any."""
        if self.mesh is None:
            return None
        nearest = round(place / self.mesh)
        away = abs(place - nearest * self.mesh)
        return nearest if nearest > 0 and away <= NEAR * float(self.axis[1]) else None

    def alias(self, line: Line) -> int | None:
        """Harmonic of the meshing beyond half the sample rate that `line` may be, if any.

        What is a harmonic itself and stands above the height of aliases is no alias.
        """
        if self.mesh is None:
            return None
        own = self.harmonic(line.place)
        carried = self.alias_share <= CARRIED or line.amplitude > HIGHEST_ALIAS * self.edge
        if own is not None and carried:
            return None
        near = NEAR * float(self.axis[1])
        found = folded_harmonic(line.place, self.mesh, self.sample_rate, near)
        return None if found == own else found


def frequency_spectrum_of(signal: Signal, sun_teeth: int | None) -> MeshSpectrum:
    """Over frequency [Hz]; the meshing's is that at the mean speed."""
    found = amplitude_spectrum(signal.samples, signal.sample_rate)
    mesh = None if sun_teeth is None else sun_teeth * abs(signal.speed) / (2.0 * math.pi)
    edge = edge_amplitude(found.frequency, found.amplitude)
    return MeshSpectrum(*found, mesh or None, _all_of(found.frequency), signal.sample_rate, edge)


def order_spectrum_of(signal: Signal, sun_teeth: int | None) -> MeshSpectrum:
    """Over orders: cycles per turn of the sun against the carrier.

    Up to what the samples resolve where the sun is fastest.

    Raises:
        ValueError: the sun stands still or turns back (see `order_spectrum`).
    """
    fastest = float(np.abs(np.diff(signal.angle)).max())
    per_turn = max(math.floor(2.0 * math.pi / max(fastest, 1e-12)), 4)
    found = order_spectrum(signal.samples, signal.angle, min(per_turn, 1 << 15))
    edge = edge_amplitude(*amplitude_spectrum(signal.samples, signal.sample_rate))
    rate = 2.0 * math.pi * signal.sample_rate / abs(signal.speed)
    return MeshSpectrum(*found, sun_teeth, _all_of(found.order), rate, edge)


def _all_of(axis: Array) -> Band:
    return Band(0.0, float(axis[-1]))
