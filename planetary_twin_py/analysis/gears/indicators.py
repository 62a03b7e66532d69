"""Condition indicators of a gear, each by its definition in the literature.

x is the average of the gear over one turn without its mean, d its difference and r its residual
signal (`gear_signals`), A(o) the amplitude of x at order o, m_k the k-th central moment, Z the
tooth number. An indicator that is not defined is NaN, and `reasons` says why. The names are those
of `gearConditionMetrics` in MATLAB, where it has them.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from typing import Annotated, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...units.catalogue import Quantity
from .gear_signals import GearSignals, gear_signals, tooth_numbers
from .mesh_band import mesh_band

Array = NDArray[np.float64]
NOTHING = 1e-6  # of the rms of the average, below which a part of it is rounding
SIDEBANDS = 6  # on each side, of the sideband energy ratio
NO_DIFFERENCE = "no difference signal: the average is regular meshing"
NO_RESIDUAL = "no residual signal: the average is mesh harmonics alone"


class ConditionIndicators(NamedTuple):
    """Condition indicators of a gear."""

    rms: Annotated[float, Quantity("RMS", "signal")]
    """Root of the mean of x^2, in the unit of the signal."""
    peak: Annotated[float, Quantity("peak", "signal")]
    """Largest magnitude of x, in the unit of the signal."""
    crest_factor: Annotated[float, Quantity("CrestFactor: peak/RMS")]
    """Peak over rms."""
    kurtosis: Annotated[float, Quantity("Kurtosis")]
    """m4/m2^2 of x, 3 for Gaussian noise (Dyer and Stewart 1978)."""
    fm0: Annotated[float, Quantity("FM0: peak to peak/mesh harmonics")]
    """Peak to peak of x over the sum of A(hZ), h = 1, 2, ... (Stewart 1977)."""
    fm4: Annotated[float, Quantity("FM4: kurtosis of the difference")]
    """m4/m2^2 of d (Stewart 1977)."""
    m6a: Annotated[float, Quantity("M6A: the same with the sixth moment")]
    """m6/m2^3 of d (Martin 1989)."""
    m8a: Annotated[float, Quantity("M8A: the same with the eighth moment")]
    """m8/m2^4 of d (Martin 1989)."""
    na4: Annotated[float, Quantity("NA4: fourth moment of the residual/variance until now")]
    """m4(r) over the squared mean of m2(r) of all records up to this one (Zakrajsek, Townsend and
    Decker 1993, NASA TM-105950)."""
    na4_star: Annotated[float, Quantity("NA4*: the same/variance of the healthy state")]
    """m4(r) over the squared mean of m2(r) of the healthy state (Decker, Handschuh and Zakrajsek
    1994)."""
    nb4: Annotated[float, Quantity("NB4: NA4 of the envelope of the mesh band")]
    """NA4 of the envelope of the band around Z (Zakrajsek, Handschuh and Decker 1994)."""
    energy_ratio: Annotated[float, Quantity("EnergyRatio: rms of difference/regular")]
    """Rms of d over rms of the regular part (Swansson 1980)."""
    energy_operator: Annotated[float, Quantity("energy operator, its kurtosis")]
    """m4/m2^2 of x_k^2 - x_(k-1) x_(k+1) (Kaiser 1990; Ma 1995)."""
    sideband_index: Annotated[float, Quantity("sideband index", "signal")]
    """Mean of A(Z - 1) and A(Z + 1), in the unit of the signal (Szczepanik 1989)."""
    sideband_level_factor: Annotated[float, Quantity("SidebandLevelFactor: first sidebands/RMS")]
    """A(Z - 1) + A(Z + 1) over the rms of x (Szczepanik 1989)."""
    sideband_energy_ratio: Annotated[float, Quantity("sideband energy ratio: 6 + 6/harmonic")]
    """Sum of A at six sidebands on each side of Z over A(Z) (Hanna et al. 2011)."""
    reasons: Mapping[str, str]
    """Why indicators are NaN, by name."""


def condition_indicators(
    average: ArrayLike,
    mesh_orders: int | Sequence[int],
    earlier: ArrayLike | None = None,
    healthy: ArrayLike | None = None,
    resolution: float = 0.0,
) -> ConditionIndicators:
    """Condition indicators of the average of a gear over one turn.

    FM4, M6A, M8A, NB4 and the energy operator have no scale: of a signal without noise they say
    nothing about the size of a fault.

    Args:
        average: over one turn of the gear, in any unit, (points,), points at least 8.
        mesh_orders: teeth of the gear; of several gears on its shaft, those of all, its own first.
        earlier: averages before this one in the order of time, (records, points), for NA4 and NB4;
            default: this is the first record.
        healthy: averages of the healthy gear, (records, points), for NA4*.
        resolution: smallest step of the samples, in their unit; parts of the average whose rms is
            below it are not used.

    Returns:
        The indicators, NaN where one is not defined, and the reasons.

    Raises:
        ValueError: see `gear_signals`; or records have another number of points.
    """
    parts = gear_signals(average, mesh_orders)
    teeth = tooth_numbers(mesh_orders)
    before = [gear_signals(one, mesh_orders) for one in _records(earlier, parts, "earlier")]
    sound = [gear_signals(one, mesh_orders) for one in _records(healthy, parts, "healthy")]
    amplitude = 2.0 * np.abs(np.fft.rfft(parts.signal)) / len(parts.signal)
    least = max(NOTHING * _rms(parts.signal), resolution)
    z = teeth[0]
    formulas: dict[str, Callable[[], float]] = {
        "rms": lambda: _rms(parts.signal),
        "peak": lambda: float(np.abs(parts.signal).max()),
        "crest_factor": lambda: float(np.abs(parts.signal).max()) / _some(parts.signal, resolution),
        "kurtosis": lambda: _moment_ratio(parts.signal, 4, resolution, "the average is constant"),
        "fm0": lambda: _fm0(parts.signal, amplitude, z, least),
        "fm4": lambda: _moment_ratio(parts.difference, 4, least, NO_DIFFERENCE),
        "m6a": lambda: _moment_ratio(parts.difference, 6, least, NO_DIFFERENCE),
        "m8a": lambda: _moment_ratio(parts.difference, 8, least, NO_DIFFERENCE),
        "na4": lambda: _na4([*_residuals(before), parts.residual], least),
        "na4_star": lambda: _na4_star(parts.residual, _residuals(sound), resolution),
        "nb4": lambda: _nb4([*(one.signal for one in before), parts.signal], z, resolution),
        "energy_ratio": lambda: _energy_ratio(parts, least),
        "energy_operator": lambda: _energy_operator(parts.signal, resolution),
        "sideband_index": lambda: 0.5 * _sidebands(amplitude, z, 1),
        "sideband_level_factor": lambda: (
            _sidebands(amplitude, z, 1) / _some(parts.signal, resolution)
        ),
        "sideband_energy_ratio": lambda: _sideband_energy_ratio(amplitude, z, least),
    }
    found, reasons = dict[str, float](), dict[str, str]()
    for name, formula in formulas.items():
        try:
            found[name] = formula()
        except _UndefinedError as reason:
            found[name], reasons[name] = math.nan, str(reason)
    return ConditionIndicators(**found, reasons=reasons)


class _UndefinedError(Exception):
    """An indicator is not defined, for the reason in the message."""


def _records(given: ArrayLike | None, parts: GearSignals, name: str) -> list[Array]:
    if given is None:
        return []
    records = np.atleast_2d(np.asarray(given, dtype=np.float64))
    if records.ndim != 2 or records.shape[1] != len(parts.signal):
        raise ValueError(
            f"{name}: shape {records.shape}: must be (records, {len(parts.signal)}), as the average"
        )
    return list(records)


def _residuals(records: list[GearSignals]) -> list[Array]:
    return [one.residual for one in records]


def _rms(values: Array) -> float:
    return math.sqrt(float(np.mean(values**2)))


def _some(signal: Array, least: float) -> float:
    """Rms of the average; it is undefined if that is zero."""
    rms = _rms(signal)
    if rms <= least:
        raise _UndefinedError("the average is constant")
    return rms


def _moment_ratio(values: Array, power: int, least: float, nothing: str) -> float:
    """Central moment over that power of the standard deviation."""
    centred = values - values.mean()
    deviation = _rms(centred)
    if deviation <= least:
        raise _UndefinedError(nothing)
    return float(np.mean((centred / deviation) ** power))


def _fm0(signal: Array, amplitude: Array, teeth: int, least: float) -> float:
    harmonics = float(amplitude[teeth::teeth].sum())
    if harmonics <= least:
        raise _UndefinedError("no mesh harmonic in the average")
    return float(np.ptp(signal)) / harmonics


def _na4(residuals: list[Array], least: float) -> float:
    """m4 of the last residual over the squared mean variance of all."""
    variance = float(np.mean([one.var() for one in residuals]))
    if math.sqrt(variance) <= least:
        raise _UndefinedError(NO_RESIDUAL)
    last = residuals[-1] - residuals[-1].mean()
    return float(np.mean(last**4)) / variance**2


def _na4_star(residual: Array, healthy: list[Array], resolution: float) -> float:
    if not healthy:
        raise _UndefinedError("needs the average of the healthy gear")
    variance = float(np.mean([one.var() for one in healthy]))
    if math.sqrt(variance) <= resolution:
        raise _UndefinedError("no residual signal of the healthy gear")
    return float(np.mean((residual - residual.mean()) ** 4)) / variance**2


def _nb4(signals: list[Array], teeth: int, resolution: float) -> float:
    if 2 * (teeth + (teeth - 1) // 2) >= len(signals[-1]):
        raise _UndefinedError("fewer than three points for each tooth")
    envelopes = [mesh_band(signal, teeth).amplitude for signal in signals]
    least = max(NOTHING * _rms(envelopes[-1]), resolution)
    variance = float(np.mean([one.var() for one in envelopes]))
    if math.sqrt(variance) <= least:
        raise _UndefinedError("the envelope of the mesh band is constant")
    return float(np.mean((envelopes[-1] - envelopes[-1].mean()) ** 4)) / variance**2


def _energy_ratio(parts: GearSignals, least: float) -> float:
    if _rms(parts.difference) <= least:
        raise _UndefinedError(NO_DIFFERENCE)
    if _rms(parts.regular) <= least:
        raise _UndefinedError("no regular meshing in the average")
    return _rms(parts.difference) / _rms(parts.regular)


def _energy_operator(signal: Array, resolution: float) -> float:
    """Kurtosis of the energy operator of Teager over one turn, which is periodic."""
    energy = signal**2 - np.roll(signal, 1) * np.roll(signal, -1)
    scale = max(NOTHING * _rms(energy), NOTHING * float(np.mean(signal**2)), resolution**2)
    return _moment_ratio(energy, 4, scale, "the energy operator is constant, as of one tone")


def _sidebands(amplitude: Array, teeth: int, number: int) -> float:
    """Sum of the amplitudes of a number of sidebands on each side of the first harmonic."""
    if number >= teeth or teeth + number >= len(amplitude):
        raise _UndefinedError(f"{number} sidebands on each side: too few teeth or points")
    around = amplitude[teeth - number : teeth + number + 1]
    return float(around.sum() - amplitude[teeth])


def _sideband_energy_ratio(amplitude: Array, teeth: int, least: float) -> float:
    sidebands = _sidebands(amplitude, teeth, SIDEBANDS)
    if amplitude[teeth] <= least:
        raise _UndefinedError("no mesh harmonic in the average")
    return sidebands / float(amplitude[teeth])
