"""What the damage of a real gearbox lacks: gaps, readings outside the map, fast torque."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from ...lifetime.steady_damage import unsteady_remark
from ...text.stamps import instant
from ...units.engineering import percent
from .counter import NODES, WEIGHTS, DamageCounter
from .rows import TORQUE_SD

SLOW = 0.2  # [s] between readings, up to which these show the torque that a map follows
SCATTER = 0.1  # of the torque within a row, for which the missing damage is stated


def damage_remarks(counter: DamageCounter, gearbox: int = 0) -> Iterator[str]:
    """Lines on what the sums of a gearbox do not contain, since the start of the program.

    Args:
        counter: counter of the damage.
        gearbox: index of the gearbox.
    """
    found, n = counter.since_start, gearbox
    if found.again[n]:
        yield (
            f"damage: {found.again[n]} readings are not later than the last one in the sums: not "
            "counted again"
        )
    if found.gaps[n]:
        yield (
            f"damage in {found.gaps[n]} gaps between readings, the longest of "
            f"{found.longest_gap[n]:.4g} s, is not known"
        )
    if (first := found.first_outside[n]) is not None:
        yield (
            f"damage: {found.outside[n]} readings are outside the map and not in the sums, the "
            f"first at {instant(first.time)}: torque up to {abs(first.torque):.4g} N m, speed "
            f"{abs(first.speed):.4g} rad/s, oil at {first.oil - 273.15:.4g} degC"
            f"{_covered(counter)}"
        )
    unsteady = getattr(counter.rates, "unsteady", ())  # a closed form has no runs
    if line := unsteady_remark(unsteady, getattr(counter.rates, "runs", 0)):
        yield f"damage: {line}"
    if found.refusal:
        yield f"damage: a reading within the map has no rate: {found.refusal}"
    yield from _fast_torque(counter, gearbox)


def _covered(counter: DamageCounter) -> str:
    """What the map covers."""
    covers = getattr(counter.rates, "range", None)
    if covers is None:
        return ""
    low, high = (value - 273.15 for value in covers.temperature)
    return (
        f"; the map has up to {covers.torque:.4g} N m and {covers.speed[1]:.4g} rad/s, {low:.4g} "
        f"to {high:.4g} degC"
    )


def _fast_torque(counter: DamageCounter, n: int) -> Iterator[str]:
    """The damage of a torque that changes within a row, if it is not given."""
    found = counter.since_start
    last, count = found.last[n], int(found.counted[n])
    if last is None or not found.without_sd[n] or found.time[n] <= SLOW * count:
        return
    torques = last.torque * (1.0 + SCATTER * NODES)
    speeds, oil = np.full(3, last.speed), np.full(3, last.oil)
    if np.any(counter.rates.outside(torques, speeds, oil)):
        return
    rates = counter.rates.rates(torques, speeds, oil)
    worst = int(np.argmax(rates[0]))
    if not rates[0, worst] > 0.0:
        return
    more = float(WEIGHTS @ rates[:, worst] / rates[0, worst]) - 1.0
    yield (
        f"damage of a torque that changes within a row is not in the sums of "
        f"{found.without_sd[n]} rows without {TORQUE_SD}: a standard deviation of "
        f"{percent(SCATTER)} adds {percent(more)} to {counter.rates.parts[worst]}"
    )
