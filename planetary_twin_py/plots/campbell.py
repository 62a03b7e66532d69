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
LABEL_HEIGHT, LABEL_WIDTH = 0.045, 0.02  # of a digit over those of the picture
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
        ends = np.arange(1, harmonics + 1) * mesh_frequency_per_speed(scene) * highest_speed
        axes.plot([0.0, highest_speed * RPM], [np.zeros(harmonics), ends], color=GREY, lw=0.8)
        for h, place in enumerate(_label_places(ends / top), 1):
            axes.annotate(
                f"{h}",
                place,
                (2, 2),
                xycoords="axes fraction",
                textcoords="offset points",
                color=GREY,
                annotation_clip=False,
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


def _label_places(ends: np.ndarray) -> list[tuple[float, float]]:
    """Where the lines of the harmonics leave the picture, apart by a label.

    Args:
        ends: heights of the lines at the highest speed over that of the picture, ascending.

    Returns:
        Places from left to right and bottom to top of the picture, 0 to 1.
    """
    right = _apart(list(ends[ends <= 1.0]), LABEL_HEIGHT)
    above = _apart([1.0 / end for end in ends[ends > 1.0]][::-1], LABEL_WIDTH)[::-1]
    return [(1.0, y) for y in right] + [(x, 1.0) for x in above]


def _apart(places: list[float], gap: float) -> list[float]:
    """The ascending places, each moved to at least `gap` after the one before."""
    found: list[float] = []
    for place in places:
        found.append(max(place, found[-1] + gap) if found else place)
    return found


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
