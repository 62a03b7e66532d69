"""Scenes whose axes move."""

import math

from power_flows import FLOWS, scene_of

from planetary_twin_py import Scene

MASSES = {"sun": 0.46, "planet": 0.177, "ring": 0.588, "carrier": 3.0}  # [kg], Chaari et al. 2006


def supports(bearing=1e8, **bearings):
    """Supports with one stiffness of all bearings, but for those named."""
    return {kind: {"mass": mass, "bearing": bearings.get(kind, bearing)}
            for kind, mass in MASSES.items()}  # fmt: skip


def planar(flow=FLOWS[0], bearings=None, **changes) -> Scene:
    """A power flow of the paper's gearbox with moving axes; planets as heavy as in torsion."""
    given = {
        "dynamics": "planar",
        "gearset.planet_mass": MASSES["planet"],
        "supports": supports(**(bearings or {})),
        "backlash": 1e-4,
    }
    return scene_of(flow, **(given | changes))


def evenly(planets):
    """Angles of so many planets, as evenly as 100 teeth allow."""
    step = 2.0 * math.pi / 100
    return tuple(step * round(100 * k / planets) for k in range(planets))
