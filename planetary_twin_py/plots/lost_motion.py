"""Lost motion: the loop of twist over torque."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from ..scene import Scene
from ..studies.lost_motion import LostMotion
from .style import BLUE, GREY, applied, panels


def lost_motion_diagram(scene: Scene, found: LostMotion) -> Figure:
    """Draw the loop, and the torques at which lost motion is measured.

    Args:
        scene: gives the title.
        found: the loop.
    """
    with applied():
        figure, (axes,) = panels(height=4.0)
        axes.plot(found.torque, np.degrees(found.twist), color=BLUE)
        small = found.share * float(found.torque.max())
        for torque in (-small, small):
            axes.axvline(torque, color=GREY, linewidth=0.8)
        axes.set_title(
            f"{scene.name}: lost motion {np.degrees(found.lost_motion):.4g} deg at "
            f"{100 * found.share:g} % of the torque"
        )
        axes.set_xlabel("Torque on the output [N m]")
        axes.set_ylabel("Twist against the held input [deg]")
    return figure
