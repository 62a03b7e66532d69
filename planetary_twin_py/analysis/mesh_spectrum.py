"""The spectrum of one mesh, by frequency or by order, and which of its lines are of the meshing."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from .orders import order_spectrum
from .signals import Signal
from .spectrum import Array, Line, amplitude_spectrum, strongest_lines

NEAR = 1.0  # [bins] from a harmonic: such a line is called one


@dataclass(frozen=True)
class MeshSpectrum:
    """`axis` [Hz or cycles per turn] and peak `amplitude` in SI (bins,).

    `mesh` is where the first harmonic of the meshing lies on the axis; None if unknown.
    """

    axis: Array
    amplitude: Array
    mesh: float | None

    def lines(self, count: int) -> list[Line]:
        """The highest, see `strongest_lines`."""
        return strongest_lines(self.axis, self.amplitude, count)

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


def frequency_spectrum_of(signal: Signal, sun_teeth: int | None) -> MeshSpectrum:
    """Over frequency [Hz]; the meshing's is that at the mean speed."""
    found = amplitude_spectrum(signal.samples, signal.sample_rate)
    mesh = None if sun_teeth is None else sun_teeth * abs(signal.speed) / (2.0 * math.pi)
    return MeshSpectrum(found.frequency, found.amplitude, mesh or None)


def order_spectrum_of(signal: Signal, sun_teeth: int | None) -> MeshSpectrum:
    """Over orders: cycles per turn of the sun against the carrier.

    Up to what the samples resolve where the sun is fastest.

    Raises:
        ValueError: the sun stands still or turns back (see `order_spectrum`).
    """
    fastest = float(np.abs(np.diff(signal.angle)).max())
    per_turn = max(math.floor(2.0 * math.pi / max(fastest, 1e-12)), 4)
    found = order_spectrum(signal.samples, signal.angle, min(per_turn, 1 << 15))
    return MeshSpectrum(found.order, found.amplitude, sun_teeth)
