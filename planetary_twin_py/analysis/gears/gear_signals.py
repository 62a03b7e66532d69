"""Parts of the average of a gear: regular meshing, and what is left without it.

Authors use the terms differently (Lebold et al. 2000, Proc. 54th MFPT, 623-634). Here they are:

- regular: orders 1 and 2 of the shaft, harmonics of the meshes, and the first sidebands of each;
- residual: without orders 1 and 2 and the harmonics; the first sidebands are kept (NA4);
- difference: without the regular part (FM4, M6A, M8A).
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..spectra.spectrum import checked

Array = NDArray[np.float64]
SHAFT_ORDERS = (1, 2)


class GearSignals(NamedTuple):
    """Parts of an average over one turn."""

    signal: Array
    """The average without its mean, in the unit of the signal, (points,)."""
    regular: Array
    """Regular meshing, (points,)."""
    residual: Array
    """Without shaft orders and mesh harmonics, (points,)."""
    difference: Array
    """Without the regular part, (points,)."""
    regular_orders: tuple[int, ...]
    """Orders of the regular part, which are not in the difference [cycles per turn]."""
    removed_from_residual: tuple[int, ...]
    """Orders that are not in the residual [cycles per turn]."""


def gear_signals(average: ArrayLike, mesh_orders: int | Sequence[int]) -> GearSignals:
    """Split the average of a gear into regular, residual and difference signal.

    Args:
        average: over one turn of the gear, in any unit, (points,), points at least 8.
        mesh_orders: teeth of the gear; of several gears on its shaft, those of all.

    Returns:
        The parts (points,), with the orders taken out. The mean is in none of them.

    Raises:
        ValueError: there are too few points or one is not finite, or fewer than two points for each
            tooth.
    """
    values, teeth = one_turn(average), tooth_numbers(mesh_orders)
    highest = len(values) // 2
    if max(teeth) > highest:
        raise ValueError(
            f"average: {len(values)} points for {max(teeth)} teeth: must be at least two a tooth"
        )
    harmonics = {order for z in teeth for order in range(z, highest + 1, z)}
    apart = set(SHAFT_ORDERS) | harmonics
    beside = {order + side for order in harmonics for side in (-1, 1)}
    regular = {order for order in apart | beside if 0 < order <= highest}
    spectrum = np.fft.rfft(values - values.mean())
    spectrum[0] = 0.0
    meshing, rest = _only(spectrum, regular, len(values)), _only(spectrum, apart, len(values))
    signal = values - values.mean()
    return GearSignals(
        signal,
        meshing,
        signal - rest,
        signal - meshing,
        tuple(sorted(regular)),
        tuple(sorted(order for order in apart if order <= highest)),
    )


def one_turn(average: ArrayLike) -> Array:
    """An average as floats; raises `ValueError` unless it is one channel, long and finite."""
    values = checked(average, "average")
    if values.ndim != 1:
        raise ValueError(f"average: shape {values.shape}: must be that of one turn, (points,)")
    return values


def tooth_numbers(mesh_orders: int | Sequence[int]) -> tuple[int, ...]:
    """Tooth numbers of the gears on a shaft; raises `ValueError` if one is below 3."""
    given = np.atleast_1d(mesh_orders)
    if not given.size or given.dtype.kind not in "iu" or given.min() < 3:
        raise ValueError(f"mesh_orders = {mesh_orders}: must be tooth numbers, at least 3")
    return tuple(given.tolist())


def _only(spectrum: NDArray[np.complex128], orders: set[int], points: int) -> Array:
    """The signal of some orders, (points,)."""
    kept = np.zeros_like(spectrum)
    at = sorted(order for order in orders if order < len(spectrum))
    kept[at] = spectrum[at]
    return np.fft.irfft(kept, points)
