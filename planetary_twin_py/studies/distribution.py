"""Distribution of the results of a sampled study."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

if TYPE_CHECKING:
    import pyarrow as pa

SHARES = (1.0, 5.0, 50.0, 95.0, 99.0)  # [%]
LEAST_BEYOND = 5  # points beyond a percentile, without which it is chance
USUAL = (
    "load_sharing_factor",
    "efficiency",
    "power_loss",
    "sun_planet_mesh_force_peak",
    "planet_ring_mesh_force_peak",
)
"""Results that are summarised unless others are named."""


class Distribution(NamedTuple):
    """Values of a result over the points of a study."""

    name: str
    points: int
    mean: float
    deviation: float
    """Standard deviation of the sample."""
    percentiles: dict[float, float]
    """Values by percentile [%], see `percentiles`."""


def percentiles(values: np.ndarray) -> dict[float, float]:
    """Percentiles that the number of values supports: five of them are beyond each.

    Args:
        values: finite numbers, (n,).

    Returns:
        Values by percentile [%]; linear between neighbours.
    """
    known = [s for s in SHARES if min(s, 100.0 - s) * len(values) >= 100.0 * LEAST_BEYOND]
    return dict(zip(known, np.percentile(values, known).tolist(), strict=True)) if known else {}


def usual_measures(table: pa.Table) -> tuple[str, ...]:
    """Names of `USUAL` that the table of a study has."""
    return tuple(name for name in USUAL if name in table.column_names)


def distributions(table: pa.Table, names: Sequence[str]) -> list[Distribution]:
    """Distributions of results; failed points and NaN are omitted.

    Args:
        table: of a study, a row per point.
        names: of numerical columns.

    Returns:
        One for each column, in SI.
    """
    found = []
    for name in names:
        values = table[name].drop_null().to_numpy()
        values = values[np.isfinite(values)]
        if len(values) > 1:
            mean, deviation = float(values.mean()), float(values.std(ddof=1))
            found.append(Distribution(name, len(values), mean, deviation, percentiles(values)))
    return found
