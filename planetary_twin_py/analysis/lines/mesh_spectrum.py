"""Spectrum of one mesh over frequency or order, with the harmonics of the mesh frequency."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Self

import numpy as np
from numpy.typing import NDArray

from ..sampling import interpolation
from ..sampling.aliases import NEGLIGIBLE, aliased_harmonic, edge_amplitude
from ..shaft import orders
from ..signals.signal import Signal
from ..spectra.band import Band
from ..spectra.spectrum import Array, Line, amplitude_spectrum, strongest_lines

NEAR = 1.0  # [bins] largest distance of a line from the harmonic that it is attributed to
MOST_PER_TURN = 1 << 15  # samples per turn of an order spectrum
HIGHEST_ALIAS = 2.0  # height of an alias over that of the lines near half the sample rate


@dataclass(frozen=True)
class MeshSpectrum:
    """Amplitude spectrum of a signal of a mesh."""

    axis: Array
    """[Hz, or cycles per turn], (bins,)."""
    amplitude: Array
    """Peak amplitude in SI, (bins,)."""
    mesh: float | None
    """Place of the first mesh harmonic on the axis; None if it is unknown."""
    band: Band
    """Part of the axis whose lines are listed."""
    sample_rate: float
    """In the unit of the axis."""
    edge: float
    """Height of the lines just below half the sample rate, see `edge_amplitude`."""
    error: float = 0.0
    """Of interpolated samples, over the height of a tone."""
    averages: int = 1
    """Number of spectra whose power was averaged."""

    @property
    def alias_share(self) -> float:
        """Approximate height of aliases over that of the highest line."""
        highest = float(self.amplitude[1:].max())
        return self.edge / highest if highest > 0.0 else 0.0

    def within(self, band: Band) -> Self:
        """The spectrum, restricted to a band.

        Args:
            band: in the unit of the axis.

        Raises:
            ValueError: the band contains no bin.
        """
        narrowed = replace(self, band=Band(band.low, min(band.high, self.band.high)))
        if not narrowed.in_band.any():
            raise ValueError(
                f"band = '{band.low:g}:{band.high:g}': must contain a value of the spectrum, which "
                f"has one every {self.axis[1]:.4g} up to {self.band.high:g}"
            )
        return narrowed

    @property
    def in_band(self) -> NDArray[np.bool_]:
        """Whether each bin is in the band, (bins,)."""
        return np.asarray((self.axis >= self.band.low) & (self.axis <= self.band.high))

    def lines(self, count: int) -> list[Line]:
        """The highest lines in the band, see `strongest_lines`.

        Args:
            count: largest number of lines.
        """
        # Peaks are searched in the whole spectrum, because the end of a band on a slope is no peak.
        found = strongest_lines(self.axis, self.amplitude, len(self.axis))
        return [line for line in found if self.band.low <= line.place <= self.band.high][:count]

    def in_mesh_orders(self, place: float) -> float | None:
        """Mesh order of a `place` on the axis: its ratio to the first mesh harmonic, if known."""
        return None if self.mesh is None else place / self.mesh

    def harmonic(self, place: float) -> int | None:
        """Number of the mesh harmonic of a line at `place` on the axis, or None."""
        if self.mesh is None:
            return None
        nearest = round(place / self.mesh)
        away = abs(place - nearest * self.mesh)
        return nearest if nearest > 0 and away <= NEAR * float(self.axis[1]) else None

    def alias(self, line: Line) -> int | None:
        """Number of the mesh harmonic above half the sample rate that `line` may be an alias of.

        None if there is no such harmonic, if the sample rate is sufficient, or if the line is a
        harmonic higher than aliases.
        """
        if self.mesh is None or self.alias_share <= NEGLIGIBLE:
            return None
        own = self.harmonic(line.place)
        if own is not None and line.amplitude > HIGHEST_ALIAS * self.edge:
            return None
        near = NEAR * float(self.axis[1])
        found = aliased_harmonic(line.place, self.mesh, self.sample_rate, near)
        return None if found == own else found


def frequency_spectrum_of(signal: Signal, sun_teeth: int | None) -> MeshSpectrum:
    """Spectrum of a signal over frequency.

    Args:
        signal: of a mesh.
        sun_teeth: number of teeth of the sun; None if it is unknown.

    Returns:
        The spectrum, with the mesh frequency at the mean speed if there is one (see
        `has_mean_speed`).
    """
    found = amplitude_spectrum(signal.samples, signal.sample_rate)
    mesh = None
    if sun_teeth is not None and signal.has_mean_speed:
        mesh = sun_teeth * abs(signal.speed) / (2.0 * math.pi)
    edge = edge_amplitude(found.frequency, found.amplitude)
    band, rate = _all_of(found.frequency), signal.sample_rate
    return MeshSpectrum(*found, mesh or None, band, rate, edge, signal.error)


def order_spectrum_of(signal: Signal, sun_teeth: int | None) -> MeshSpectrum:
    """Spectrum of a signal over orders, in cycles per turn of the sun relative to the carrier.

    Args:
        signal: of a mesh.
        sun_teeth: number of teeth of the sun; None if it is unknown.

    Returns:
        The spectrum. Its band ends at 0.47 times the sample rate at the highest speed of the sun,
        up to which amplitudes are exact to 1 %.

    Raises:
        ValueError: the sun is at rest or reverses; or see `order_spectrum`.
    """
    return order_spectra_of([signal], sun_teeth)[0]


def order_spectra_of(signals: Sequence[Signal], sun_teeth: int | None) -> list[MeshSpectrum]:
    """Spectra over orders with the same axis, of as many turns as the shortest signal has.

    Args:
        signals: of meshes or sensors.
        sun_teeth: number of teeth of the sun; None if it is unknown.

    Raises:
        ValueError: see `order_spectrum_of`.
    """
    for signal in signals:
        _check_one_way(signal)
    highest = [_resolved(signal) for signal in signals]
    per_turn = min(max(math.ceil(max(highest) / orders.EXACT), 4), MOST_PER_TURN)
    resampled = [orders.resample_by_angle(s.samples, s.angle, per_turn).samples for s in signals]
    points = min(map(len, resampled))
    found = []
    for signal, resolved, samples in zip(signals, highest, resampled, strict=True):
        spectrum = amplitude_spectrum(samples[:points], float(per_turn))
        edge = edge_amplitude(*amplitude_spectrum(signal.samples, signal.sample_rate))
        rate = 2.0 * math.pi * signal.sample_rate / abs(signal.speed)
        band = Band(0.0, min(resolved, orders.EXACT * per_turn))
        error = signal.error + interpolation.ERROR
        found.append(MeshSpectrum(*spectrum, sun_teeth, band, rate, edge, error))
    return found


def _resolved(signal: Signal) -> float:
    """Order up to which the samples are exact at the highest speed of the sun."""
    fastest = float(np.abs(np.diff(signal.angle)).max())
    return interpolation.EXACT * 2.0 * math.pi / max(fastest, 1e-12)


def _check_one_way(signal: Signal) -> None:
    """Raise `ValueError` with the time if the sun rests or reverses relative to the carrier."""
    steps = np.diff(signal.angle)
    sense = np.sign(steps[np.flatnonzero(steps)[:1]].sum())
    for place in np.flatnonzero(sense * steps <= 0.0)[:1]:
        what = "stands still" if steps[place] == 0.0 else "reverses"
        raise ValueError(
            f"the sun {what} relative to the carrier at {signal.time[place]:.6g} s: select an "
            "interval in which it turns in one direction by --from and --to"
        )


def _all_of(axis: Array) -> Band:
    return Band(0.0, float(axis[-1]))
