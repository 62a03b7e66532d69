"""Where faults act: the kinds of mesh, the tooth pairs, and places on the path of contact.

Pairs are numbered in the order in which they pass the pitch point. On the drive side, pair n of a
mesh is tooth n of both gears, modulo their numbers of teeth and counted backwards on the second
gear. On the coast side the motion is mirrored and half a pitch later: pair n is tooth -n of the
first gear and tooth 1 - n of the second.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from .._core import MESHES, NOWHERE
from ..gearset.kinematics import Teeth
from ..scene.faults import SPALL_EDGE, Bearing, Crack, Fault, Pin, Spall


def spalls(faults: Sequence[Fault]) -> list[Spall]:
    """The spalls among faults."""
    return [fault for fault in faults if isinstance(fault, Spall)]


def fault_kinks(faults: Sequence[Fault], kind: int) -> tuple[float, ...]:
    """Positions on the path of contact of a kind of mesh at which a fault begins or ends."""
    ends = [(f.begin, f.end) for f in spalls(faults) if kind in kinds_of(f)]
    return tuple(
        kink for begin, end in ends for kink in (begin, begin + SPALL_EDGE, end - SPALL_EDGE, end)
    )


def kinds_of(fault: Fault) -> tuple[int, ...]:
    """Kinds of mesh on whose tooth pairs a fault acts."""
    if isinstance(fault, Pin | Bearing):
        return ()
    if fault.gear != "planet":
        return (0,) if fault.gear == "sun" else (1,)
    if isinstance(fault, Crack):
        return (0, 1)
    return (0,) if fault.mesh == "sun" else (1,)


def faulty_pairs(
    fault: Fault, teeth: Teeth, planets: Sequence[int], phases: np.ndarray
) -> np.ndarray:
    """Numbers of the pair with the tooth of a fault, or of its tooth 0 if all teeth have it.

    Args:
        fault: the fault.
        teeth: tooth numbers.
        planets: that are integrated, counted from 0.
        phases: of their sun meshes and then of their ring meshes, with whole cycles (meshes,).

    Returns:
        Numbers on the drive and on the coast side, or NOWHERE, (MESHES, 2).
    """
    pairs = np.full((MESHES, 2), NOWHERE)
    for i in range(len(phases)):
        kind, n = divmod(i, len(planets))
        own = getattr(fault, "gear", "") != "planet" or fault.planet in ("all", planets[n] + 1)
        if own and kind in kinds_of(fault):
            pairs[i] = _pairs(fault, teeth, kind, phases[n] - phases[i])
    return pairs


def _pairs(fault: Fault, teeth: Teeth, kind: int, lead: float) -> tuple[int, int]:
    """Numbers of the faulty pair in a mesh, on the drive and on the coast side.

    The sun mesh of the same planet is `lead` mesh cycles later.
    """
    assert not isinstance(fault, Pin | Bearing)
    tooth = getattr(fault, "tooth", 0)
    number = 0 if tooth == "all" else tooth
    if fault.gear == "planet" and kind == 1:
        # A tooth meets the ring half a turn after the sun, with its other flank.
        number += round(lead + 0.5 * teeth.planet - 0.5)
    first = fault.gear == ("sun", "planet")[kind]
    modulus = 1 if tooth == "all" else teeth._asdict()[fault.gear]
    drive, coast = number % modulus, (-number if first else 1 - number) % modulus
    if isinstance(fault, Crack):
        return drive, coast
    return (drive, NOWHERE) if fault.flank == "drive" else (NOWHERE, coast)
