"""What faults need of the scene they are in."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import Any, NamedTuple

from .faults import Bearing, Crack, Fault, Pitch
from .gearset import Gearset
from .supports import Rolling, Supports

MOVING_AXES = ("planar", "spatial")
"""Dynamics in which the elements of bearings are deflected."""


class Faulted(NamedTuple):
    """What of a scene its faults need."""

    gearset: Gearset
    stiffness: str
    """Law of the stiffness of the meshes."""
    dynamics: str
    supports: Supports | None


def errors_of_faults(faults: Sequence[Fault], scene: Faulted) -> Iterator[str]:
    """Errors of faults that do not fit their scene.

    Args:
        faults: the faults.
        scene: where they are.

    Yields:
        A line for each tooth, planet or bearing that the scene lacks, for each crack with a depth
        if the stiffness is not that of the involute, and for growth that the dynamics lack.
    """
    for n, fault in enumerate(faults):
        yield from (f"faults.{n}{line}" for line in _errors(fault, scene))


def _errors(fault: Fault, scene: Faulted) -> Iterator[str]:
    gearset = scene.gearset
    teeth = getattr(gearset.teeth, getattr(fault, "gear", "sun"))
    for name, last in (("tooth", teeth - 1), ("planet", gearset.planets)):
        value: Any = getattr(fault, name, "all")
        if value != "all" and value > last:
            yield f".{name} = {value}: must be at most {last}"
    if isinstance(fault, Crack) and fault.depth is not None and scene.stiffness != "involute":
        yield ".depth: requires mesh.stiffness = involute; otherwise give stiffness_loss"
    if isinstance(fault, Pitch) and len(fault.deviations) not in (0, teeth):
        entries = len(fault.deviations)
        yield f".deviations: has {entries} entries: must have {teeth}, one a tooth"
    if fault.growing is not None and scene.dynamics.startswith("quasi_static"):
        yield ".growth: requires dynamics other than quasi-static"
    if isinstance(fault, Bearing):
        yield from _errors_of_bearing(fault, scene)


def _errors_of_bearing(fault: Bearing, scene: Faulted) -> Iterator[str]:
    if scene.dynamics not in MOVING_AXES:
        yield (
            f": a pit in a bearing requires dynamics = {' or '.join(MOVING_AXES)}, in which "
            f"bearings yield, instead of {scene.dynamics!r}"
        )
    if fault.bearing == scene.gearset.held:
        yield f".bearing = {fault.bearing!r}: does not turn, as gearset.held = {fault.bearing!r}"
    rolling: Rolling | None = getattr(getattr(scene.supports, fault.bearing, None), "rolling", None)
    if rolling is None:
        yield f": requires the rollers or balls of supports.{fault.bearing}.rolling"
        return
    apart = math.pi if fault.element == "roller" else 2.0 * math.pi / rolling.elements
    if fault.width > apart:
        yield f".width = {fault.width:g}: must be at most {apart:.4g} rad, one element at a time"
