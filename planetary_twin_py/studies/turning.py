"""Warnings about runs that are too short for means, and about deviations of the mean speed."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator
from typing import TYPE_CHECKING

from ..model.layout import Layout
from ..scene import Scene
from ..statics.error_turns import WHOLE_TURN
from ..units.catalogue import ERROR_TURNS, SPEED_SHARE

if TYPE_CHECKING:
    import pyarrow as pa

ALLOWED = 0.05  # relative deviation of the mean speed
WHOLE = 0.99  # part of a mesh cycle that counts as one: vibration delays gears by less
MANY = 10.0  # mesh cycles from which on a part of one hardly changes means
EXACT = 0.02  # part of a mesh cycle that may be missing from a whole number of them
STANDSTILL = 1e-6  # [Hz] of the mesh
PARTIAL = (
    "means of losses, forces and DTE depend on where the teeth are, unless the number of cycles is "
    f"whole or above {MANY:g}"
)
ADVICE = (
    "the speed loop has not settled or yields to the meshes: exclude more with --settling, "
    "simulate longer, or raise drive.speed_control.bandwidth"
)


def speed_share(scene: Scene, found: float) -> float:
    """Mean mesh frequency of a run over that of the operating point.

    Args:
        scene: the scene.
        found: mean mesh frequency of a run of the scene [Hz].

    Returns:
        The ratio; NaN if the set-point is standstill, or if `start_speed` starts a run-up.
    """
    wanted = Layout(scene).mesh_frequency
    runs_up = scene.drive.speed_control.start_speed is not None
    return math.nan if runs_up or not wanted > STANDSTILL else found / wanted


def off_speed(share: float) -> bool:
    """Whether the mean speed deviates from that of the operating point.

    Args:
        share: result of `speed_share`.
    """
    return abs(share - 1.0) > ALLOWED  # NaN is no deviation


def part_counts(cycles: float) -> bool:
    """Whether means depend on where the teeth are: few mesh cycles, not a whole number."""
    return cycles < MANY and abs(cycles - round(cycles)) > EXACT


def turning_of_study(table: pa.Table) -> Iterator[str]:
    """Warnings of a study about the mesh cycles and the mean speeds of its points.

    Args:
        table: table from `tabulate`, with its settings.

    Returns:
        A sentence about the points with less than a mesh cycle, another about those at a mean
        speed that is not that of their operating point, another about those with a few mesh cycles
        and a part of one, another about those whose load shares are those of a part of a turn.
    """
    settings = json.loads(table.schema.metadata[b"settings"])
    duration = settings.get("duration", math.inf)  # a Stribeck curve has whole mesh cycles
    rows = zip(table["mesh_frequency"].to_pylist(), table[SPEED_SHARE].to_pylist(), strict=True)
    few_cycles, shares, partial = [], [], []
    for frequency, share in rows:
        if share is None or math.isnan(share):
            continue
        if frequency * duration < WHOLE:
            few_cycles.append(frequency * duration)
        elif off_speed(share):
            shares.append(share)
        elif part_counts(cycles := frequency / share * duration):
            partial.append(cycles)
    if few_cycles:
        yield (
            f"{len(few_cycles)} of {len(table)} points cover less than a mesh cycle, down to "
            f"{min(few_cycles):.2g}: their means depend on where the teeth are; increase --duration"
        )
    if shares:
        worst = max(shares, key=lambda share: abs(math.log(max(share, 1e-12))))
        yield (
            f"at {len(shares)} of {len(table)} points ({SPEED_SHARE}) the gears turn at another "
            f"speed than that of the operating point on average, at worst {worst:.3g} times it, "
            f"because {ADVICE}"
        )
    if partial:
        longer = MANY * duration / min(partial)
        yield (
            f"{len(partial)} of {len(table)} points cover few mesh cycles and a part of one, down "
            f"to {min(partial):.3g}: {PARTIAL}; use --duration {math.ceil(1e3 * longer) / 1e3:g}s "
            "and more"
        )
    if ERROR_TURNS in table.column_names and "duration" in settings:
        turns = [n for n in table[ERROR_TURNS].to_pylist() if n is not None and n < WHOLE_TURN]
        if turns:
            yield (
                f"at {len(turns)} of {len(table)} points ({ERROR_TURNS}) errors that turn against "
                f"the planets cover less than a turn, down to {min(turns):.2g}: load shares are "
                "those of this part; increase --duration, or see load-sharing"
            )
