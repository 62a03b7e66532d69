"""Profiles of worn flanks along the path of contact."""

from __future__ import annotations

from matplotlib.figure import Figure

from ..studies.wear.result import Wear
from .style import GREY, applied, panels

TITLES = ("Sun-planet meshes", "Planet-ring meshes")
NAMES = {
    "sun": "sun", "planet_sun": "planets", "planet_ring": "planets", "ring": "ring",
}  # fmt: skip


def wear_profiles(found: Wear) -> Figure:
    """Draw the depths of both flanks of each kind of mesh."""
    with applied():
        figure, axes = panels(2, height=3.2)
        for kind, (panel, title) in enumerate(zip(axes, TITLES, strict=True)):
            for flank in found.flanks[2 * kind : 2 * kind + 2]:
                panel.plot(flank.position, 1e6 * flank.depth, label=NAMES[flank.name])
            panel.axvline(0.0, color=GREY, linewidth=0.8)
            panel.set_title(title)
            panel.set_xlabel("Position after the pitch point [base pitches]")
            panel.set_ylabel("Depth [µm]")
            panel.legend()
        figure.suptitle(
            f"{found.scene.name} after {found.duration / 3600.0:g} h, k = "
            f"{found.coefficient:.3g} 1/Pa{', fitted' if found.fitted else ''}"
        )
    return figure
