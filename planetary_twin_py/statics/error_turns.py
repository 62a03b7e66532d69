"""Turns of errors against the planets: in a part of a turn, load shares are those of this part."""

from __future__ import annotations

from typing import NamedTuple

from ..scene import Scene

WHOLE_TURN = 0.99  # of a turn that counts as one: vibration delays gears by less


class ErrorTurns(NamedTuple):
    """Turns of an error, in the frame of the carrier."""

    field: str
    """Field of the scene."""
    turns: float
    """Turns in a run."""


def fewest_turns(scene: Scene, cycles: float, carrier: float) -> ErrorTurns | None:
    """The error that has turned least against the planets.

    A runout turns with its gear, once in as many mesh cycles as this has teeth. Offsets of bearings
    and weight stand still in the housing, in which the carrier turns.

    Args:
        scene: the scene.
        cycles: mesh cycles of a run.
        carrier: turns of the carrier in it.

    Returns:
        The error; None if none turns against the planets.
    """
    teeth, runout, errors = scene.gearset.tooth_numbers, scene.mesh.runout, scene.errors
    found = [
        ErrorTurns(f"mesh.runout.{kind}", cycles / getattr(teeth, kind))
        for kind in teeth._fields
        if getattr(runout, kind)
    ]
    standing = {
        "errors.ring_offset": errors.ring_offset.size,
        "errors.carrier_offset": errors.carrier_offset.size,
        "supports.gravity": 0.0 if scene.supports is None else scene.supports.gravity,
    }
    if scene.gearset.held != "carrier":
        found += [ErrorTurns(field, carrier) for field, size in standing.items() if size]
    return min(found, key=lambda error: error.turns, default=None)
