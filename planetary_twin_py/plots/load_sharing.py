"""Load sharing: the share of each planet against the angle of the input, and orbits of the axes."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from ..model.planar_rows import CENTRAL
from ..scene import Scene
from ..statics.load_sharing import LoadSharing
from .style import GREY, applied, panels

MICRO = 1e6
DASHES = ("-", "-", "--", "--")
VISIBLE = 1e-3  # of the largest displacement, below which an axis is at rest
SHARE_SPAN = 0.02  # smallest range of the axis of shares


def load_sharing_diagram(scene: Scene, found: LoadSharing) -> Figure:
    """Draw the shares of all planets, and the orbits of the axes that move.

    Args:
        scene: gives the title.
        found: forces and displacements.
    """
    with applied():
        figure, (shares, orbits) = panels(2, 3.4)
        for i, share in enumerate(found.share.T):
            dash = DASHES[i % len(DASHES)]  # curves of several planets may coincide
            shares.plot(360.0 * found.turns, share, dash, label=f"planet {i + 1}")
        low, high = shares.get_ylim()
        if high - low < SHARE_SPAN:
            middle = 0.5 * (low + high)
            shares.set_ylim(middle - 0.5 * SHARE_SPAN, middle + 0.5 * SHARE_SPAN)
        shares.set_title(f"{scene.name}: share of the torque")
        shares.set_xlabel("Angle of the input [deg]")
        shares.set_ylabel("Torque of a planet/mean [-]")
        shares.legend()
        moved = MICRO * found.displacement
        visible = VISIBLE * np.abs(moved).max()
        for k, body in enumerate(CENTRAL):
            if np.abs(moved[:, k]).max() > visible:
                orbits.plot(*moved[:, k].T, label=body, marker="o", markersize=3)
        orbits.plot(0.0, 0.0, "+", color=GREY, markersize=12, label="nominal")
        orbits.set_aspect("equal", adjustable="datalim")
        orbits.set_title("Axes, in the frame of the carrier")
        orbits.set_xlabel("x [um]")
        orbits.set_ylabel("y [um]")
        orbits.legend()
    return figure
