"""Campbell diagram: natural frequencies, mesh harmonics and their crossings."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ..modal.campbell import HARMONICS, Resonance, mesh_frequency_per_speed
from ..modal.excitation import EXCITED
from ..modal.modes import NaturalModes
from ..scene import Scene
from .style import GREY, applied, colour_of, panels

RPM = 30.0 / np.pi  # per rad/s
MARGIN = 1.1  # highest frequency shown/highest natural frequency


def campbell_diagram(
    scene: Scene,
    modes: NaturalModes,
    found: tuple[Resonance, ...],
    highest_speed: float,
    harmonics: int = HARMONICS,
) -> Figure:
    """Draw frequencies against the speed of the first motor.

    Args:
        scene: gives the mesh frequency and the title.
        modes: modes at mean mesh stiffness; modes of one kind have the same colour.
        found: crossings to mark, from `resonances`.
        highest_speed: end of the speed axis [rad/s].
        harmonics: number of mesh harmonics.

    Returns:
        The figure.
    """
    with applied():
        figure, (axes,) = panels(height=4.5)
        top = MARGIN * float(modes.frequencies.max())
        kinds = sorted({kind for kind, f in zip(modes.kinds, modes.frequencies, strict=True) if f})
        for kind in kinds:
            frequencies = modes.frequencies[[k == kind for k in modes.kinds]]
            axes.hlines(
                frequencies, 0.0, highest_speed * RPM, label=kind, color=colour_of(kinds, kind)
            )
        for h in range(1, harmonics + 1):
            end = h * mesh_frequency_per_speed(scene) * highest_speed
            axes.plot([0.0, highest_speed * RPM], [0.0, end], color=GREY, lw=0.8)
            share = min(1.0, top / end)  # fraction of the line inside the picture
            place = (share * highest_speed * RPM, share * end)
            axes.annotate(
                f"{h}", place, (2, 2), textcoords="offset points", color=GREY, clip_on=False
            )
        _mark(axes, [r for r in found if r.excitation == EXCITED], "excited by a mesh harmonic")
        if others := [r for r in found if r.excitation != EXCITED]:
            _mark(axes, others, "met, not excited", fill="white")
        axes.set(
            xlim=(0.0, highest_speed * RPM),
            ylim=(0.0, top),
            xlabel="speed of the first motor [rpm]",
            ylabel="frequency [Hz]",
            title=f"{scene.name}: natural frequencies at mean mesh stiffness\n",
        )
        figure.legend(loc="outside lower center", ncols=len(kinds) + 2)
    return figure


def _mark(axes: Axes, found: list[Resonance], label: str, fill: str = "black") -> None:
    """Draw circles with a colour inside where harmonics meet frequencies."""
    axes.plot(
        [r.speed * RPM for r in found],
        [r.frequency for r in found],
        "o",
        color="black",
        markerfacecolor=fill,
        label=label,
        zorder=3,
    )
