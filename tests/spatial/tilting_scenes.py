"""Scenes whose axes tilt and move along themselves."""

from planar.moving_scenes import planar
from power_flows import FLOWS

from planetary_twin_py import Scene

AXIAL = {"sun": 3e7, "planet": 5e7, "ring": 8e7, "carrier": 6e7}  # [N/m]
TILTING = {"sun": 4e7, "planet": 7e7, "ring": 9e7, "carrier": 5e7}  # [N/m]
BODIES = ("sun", "planet", "ring", "carrier")


def lean(axial=None, tilting=None):
    """Fields of axial and tilting bearings."""
    fields = {f"supports.{body}.axial": AXIAL[body] if axial is None else axial for body in BODIES}
    return fields | {
        f"supports.{body}.tilting": TILTING[body] if tilting is None else tilting for body in BODIES
    }


def spatial(flow=FLOWS[0], bearings=None, helix=0.3, **changes) -> Scene:
    """A power flow of the paper's gearbox with helical teeth and axes that tilt."""
    given = {"dynamics": "spatial", "gearset.helix_angle": helix} | lean()
    return planar(flow, bearings, **(given | changes))
