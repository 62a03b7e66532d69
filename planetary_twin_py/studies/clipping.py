"""Warnings about viscous friction that its law clips to zero at low pressure."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

from ..units.catalogue import CLIPPED, SIDES

if TYPE_CHECKING:
    import pyarrow as pa

THRESHOLD = 0.01  # fraction of the time in contact above which clipping is reported


def clipping_of_run(shares: Mapping[str, float]) -> str | None:
    """Warning of a run.

    Args:
        shares: fraction of the time in contact by kind of mesh, from `clipped_friction`.

    Returns:
        A sentence, or None if no fraction exceeds the threshold.
    """
    clipped = [
        _of(side, f"{100.0 * share:.3g} %") for side, share in shares.items() if share > THRESHOLD
    ]
    return _line(clipped) if clipped else None


def clipping_of_study(table: pa.Table) -> str | None:
    """Warning of a study, with the number of points and the largest fraction of time.

    Args:
        table: table from `tabulate`.

    Returns:
        A sentence, or None if no fraction exceeds the threshold.
    """
    shares = {side: table[f"{side}_{CLIPPED}"].to_pylist() for side in SIDES}
    largest = {
        side: max((s or 0.0 for s in column), default=0.0) for side, column in shares.items()
    }
    points = sum(
        max(s or 0.0 for s in row) > THRESHOLD for row in zip(*shares.values(), strict=True)
    )
    clipped = [
        _of(side, f"up to {100.0 * s:.3g} %") for side, s in largest.items() if s > THRESHOLD
    ]
    return f"{_line(clipped)}; at {points} of {len(table)} points" if clipped else None


def _of(side: str, share: str) -> str:
    return f"{share} ({side.replace('_', '-')} meshes)"


def _line(clipped: list[str]) -> str:
    return (
        f"viscous friction is clipped to zero for {' and '.join(clipped)} of the time in contact: "
        "the pressure is too low for its law, and the power loss is underestimated"
    )
