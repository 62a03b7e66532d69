"""Single pitch deviations of a gear: given, or drawn within a flank tolerance class."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from ..scene import Scene
from ..scene.faults import Pitch

Array = NDArray[np.float64]


def material(scene: Scene, fault: Pitch) -> Array:
    """Material of each tooth towards the flanks of its mate [m], (teeth,); mean zero."""
    single = np.array(fault.deviations) if fault.grade is None else _drawn(scene, fault)
    place = np.cumsum(single - single.mean())
    return np.asarray(fault.scale * (place - place.mean()))


def pitch_tolerances(grade: int, module: float, diameter: float) -> tuple[float, float]:
    """Tolerances of single and of cumulative pitch deviations (ISO 1328-1:2013, 5.3.1 and 5.3.2).

    Args:
        grade: flank tolerance class.
        module: normal module [m].
        diameter: reference diameter [m].

    Returns:
        f_pT and F_pT [m].
    """
    m, d, step = 1e3 * module, 1e3 * diameter, math.sqrt(2.0) ** (grade - 5)
    single = 0.001 * d + 0.4 * m + 5.0
    total = 0.002 * d + 0.55 * math.sqrt(d) + 0.7 * m + 12.0
    return 1e-6 * single * step, 1e-6 * total * step


def _drawn(scene: Scene, fault: Pitch) -> Array:
    """Independent deviations, as large as both tolerances of the class allow."""
    gearset = scene.gearset
    teeth = int(gearset.tooth_numbers._asdict()[fault.gear])
    assert fault.grade is not None
    module = gearset.transverse.module
    normal = module * math.cos(gearset.helix_angle)
    most, total = pitch_tolerances(fault.grade, normal, module * teeth)
    drawn: Array = np.random.default_rng(fault.seed).normal(size=teeth)
    drawn -= drawn.mean()
    reach = float(np.ptp(np.cumsum(drawn)))
    return np.asarray(drawn * min(most / float(np.abs(drawn).max()), total / reach))
