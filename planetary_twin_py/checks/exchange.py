"""Longest stable step of the explicit exchange between two twins in series.

At the shared shaft, the flange of one twin (port `torque`, inertia J, on its own shaft k1, c1)
moves the end of the shaft k, c of the other (port `motion`), whose torque acts back one step later.
Let the gears beyond both shafts be at rest. Each twin integrates its part exactly; with u = h w1/2
and w1^2 = k1/J, the recursion without damping has the eigenvalue -1 where u tan u = k1/k. To 3 %,
and never above it, that is

    h = 2 sqrt(J/K),  K = k + (4/pi^2) k1,

2 sqrt(J/k) of symplectic Euler if the flange is on no other spring. Damping of the shaft reduces it
to (sqrt(c^2 + 4 J K) - c)/K.

With `interpolation: linear`, a value is reached at the end of its step: half a step later in the
mean. A delay of half a step is a damping of -h k/2 of the shaft. So the exchange is stable only if
h < (c + c1)/k, or twice that if one twin of the two interpolates.
"""

from __future__ import annotations

import math

from ..scene import Scene, SceneError
from ..scene.drive import Machine
from ..scene.given import check_scene


def check_exchange(first: Scene, second: Scene, step: float) -> float:
    """Check the step with which two twins in series exchange speed and torque.

    Args:
        first: scene whose output shaft is the input shaft of `second`; its output port is `torque`
            and the input port of `second` is `motion`, or the other way round.
        second: scene behind it.
        step: of the exchange [s].

    Returns:
        The largest stable step [s], with the gears of both twins at rest.

    Raises:
        ValueError: the ports do not fit, or the step is too long.
    """
    for scene in (first, second):
        check_scene(scene)
    flange, shaft = sides = first.drive.output, second.drive.input
    if shaft.port == "torque":
        flange, shaft = sides[::-1]
    if (flange.port, shaft.port) != ("torque", "motion"):
        raise SceneError(
            f"drive.output.port = {sides[0].port!r}, drive.input.port = {sides[1].port!r}: one of "
            "the two must be 'torque' and the other 'motion' where two twins are in series"
        )
    late = [scene.drive.interpolation for scene in (first, second)].count("linear")
    limit = _limit(flange, shaft, late)
    if not 0.0 < step <= limit:
        remedy = ", or choose drive.interpolation = hold" if late else ""
        raise ValueError(
            f"step = {step:g} s: must be above 0 and at most {limit:.3g} s, above which the "
            f"exchange of {flange.inertia:g} kg m^2 on shafts of {flange.coupling_stiffness:g} and "
            f"{shaft.coupling_stiffness:g} N m/rad is unstable{remedy}"
        )
    return limit


def _limit(flange: Machine, shaft: Machine, late: int) -> float:
    """Largest stable step [s]; `late` twins interpolate linearly."""
    stiffness = shaft.coupling_stiffness + 4.0 / math.pi**2 * flange.coupling_stiffness
    damping, inertia = shaft.coupling_damping, flange.inertia
    limit = (math.sqrt(damping**2 + 4.0 * inertia * stiffness) - damping) / stiffness
    if late:
        decay = (damping + flange.coupling_damping) / shaft.coupling_stiffness
        limit = min(limit, 2.0 / late * decay)
    return limit
