"""What is said of the gearboxes of a fleet: their number, changes, faults and warnings."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

from .groups import GearboxResult

SHOWN = 20  # gearboxes with events
STEP = 0.1  # of the loss torque, which users look for


def state_lines(found: Sequence[GearboxResult]) -> Iterator[str]:
    """The number of gearboxes, then those that contradict the scene, then those that changed."""
    judged = [one for one in found if one.is_judged]
    changed = [one for one in judged if one.events]
    estimated = sum(math.isfinite(one.estimates["friction_level"][0]) for one in found)
    blind = sum(one.scatters and one.smallest_step > STEP for one in judged)
    hidden = f"; {blind} may hide a step of {100.0 * STEP:g} % in their scatter" if blind else ""
    changes = f"{len(changed) or 'none'} changed" if judged else "none judged"
    yield f"{len(found)} gearboxes, friction level of {estimated} estimated, {changes}{hidden}"
    faulty = [one for one in found if one.fault]
    for one in faulty[:SHOWN]:
        yield f"{one.gearbox}: readings contradict the scene, not estimated: {one.fault}"
    if len(faulty) > SHOWN:
        yield f"and {len(faulty) - SHOWN} more contradict it; --out has all"
    for one in changed[:SHOWN]:
        yield from _changes(one)
    if len(changed) > SHOWN:
        yield f"and {len(changed) - SHOWN} more; --out has all"
    yield from _damage([one for one in found if one.damage is not None])


def _damage(found: Sequence[GearboxResult]) -> Iterator[str]:
    """The gearbox with the largest damage, and its part."""
    largest = [(float(one.damage.sums.max()), one) for one in found if one.damage is not None]
    if not largest:
        return
    damage, one = max(largest, key=lambda each: each[0])
    if one.damage is not None and damage > 0.0:
        yield f"largest damage: {damage:.4g} of {one.damage.worst} of {one.gearbox}"


def _changes(one: GearboxResult) -> Iterator[str]:
    if not one.fits:
        yield (
            f"{one.gearbox}: readings do not fit the scene: {len(one.events)} steps in close "
            "succession; check units, signs and gains of its sensors"
        )
        return
    for event in one.events:
        yield (
            f"{one.gearbox}: loss torque changed by about {100.0 * event.share:+.3g} % of the "
            f"scene's or more, since {event.since:g} s, found at {event.found:g} s"
        )


def warnings_of(found: Sequence[GearboxResult]) -> Iterator[str]:
    """Gearboxes with a large scatter, with a doubtful unit, and without complete readings."""
    scattering = [one for one in found if one.scatters and not one.fault]
    if scattering:
        yield _scatter(scattering)
    lines = [f"{one.gearbox}: {line}" for one in found if not one.fault for line in one.remarks]
    for one in found:
        count, first = one.missing
        if count:
            lines.append(
                f"{one.gearbox}: at {count} times of the table, the first at {first:g} s, a torque "
                "or the speed is missing; these rows are not used"
            )
        if one.damage is not None:
            lines += [f"{one.gearbox}: {line}" for line in one.damage.warnings]
            lines += [f"{one.gearbox}: {line}" for line in one.damage_remarks]
    yield from lines[:SHOWN]
    if len(lines) > SHOWN:
        yield f"and {len(lines) - SHOWN} more lines; --json has all"


def _scatter(found: Sequence[GearboxResult]) -> str:
    """What the scatter of these gearboxes is, means and does."""
    names = ", ".join(one.gearbox for one in found[:SHOWN])
    if len(found) > SHOWN:
        names += f" and {len(found) - SHOWN} more"
    measured, stated = zip(*(one.scatter for one in found), strict=True)
    steps = [one.smallest_step for one in found]
    return (
        f"{names}: the torque balance scatters by {_range(measured)} N m, the sensors explain "
        f"{_range(stated)} N m: rows are instants of a wandering speed or shorter than its wander, "
        "or noise in --sensors is too small; intervals are wider, and steps of less than "
        f"{_range([100.0 * step for step in steps])} % of the loss may not be found"
    )


def _range(values: Sequence[float]) -> str:
    """Smallest and largest of some values, with two digits each."""
    low, high = (f"{float(f'{value:.2g}'):g}" for value in (min(values), max(values)))
    return low if low == high else f"{low} to {high}"
