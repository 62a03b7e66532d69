"""Viscous friction that its law clips to zero for want of pressure, in words."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

from .measures import CLIPPED, SIDES

if TYPE_CHECKING:
    import pyarrow as pa

TOLD = 0.01  # share of the time in contact from which a clipped friction is told


def clipping_of_run(shares: Mapping[str, float]) -> str | None:
    """What whoever reads the figures of a run must know of it, from its `clipped_friction`."""
    told = [_of(side, f"{100.0 * share:.3g} %") for side, share in shares.items() if share > TOLD]
    return _line(told) if told else None


def clipping_of_study(table: pa.Table) -> str | None:
    """The same of a study: at how many of the points of its `table`, and at most for how long."""
    shares = {side: table[f"{side}_{CLIPPED}"].to_pylist() for side in SIDES}
    largest = {
        side: max((s or 0.0 for s in column), default=0.0) for side, column in shares.items()
    }
    points = sum(max(s or 0.0 for s in row) > TOLD for row in zip(*shares.values(), strict=True))
    told = [_of(side, f"up to {100.0 * s:.3g} %") for side, s in largest.items() if s > TOLD]
    return f"{_line(told)}; at {points} of {len(table)} points" if told else None


def _of(side: str, share: str) -> str:
    return f"{share} ({side.replace('_', '-')} meshes)"


def _line(told: list[str]) -> str:
    return (
        f"viscous friction is clipped to zero for {' and '.join(told)} of the time in contact: "
        "the pressure is too low for its law, and the power loss comes out too low"
    )
