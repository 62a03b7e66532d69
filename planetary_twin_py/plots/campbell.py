"""Campbell diagram: natural frequencies, mesh harmonics and their crossings."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ..modal.campbell import HARMONICS, MeshLine, Resonance, mesh_line
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
        scene: gives the mesh frequency, the speed of a second motor, and the title.
        modes: modes at mean mesh stiffness; modes of one kind have the same colour.
        found: crossings to mark, from `resonances`.
        highest_speed: end of the speed axis [rad/s]; its start is that of `MeshLine.lowest_speed`.
        harmonics: number of mesh harmonics.

    Returns:
        The figure.
    """
    line = mesh_line(scene)
    ends = line.lowest_speed(highest_speed), highest_speed
    with applied():
        figure, (axes,) = panels(height=4.5)
        top = MARGIN * float(modes.frequencies.max())
        kinds = sorted({kind for kind, f in zip(modes.kinds, modes.frequencies, strict=True) if f})
        for kind in kinds:
            frequencies = modes.frequencies[[k == kind for k in modes.kinds]]
            axes.hlines(
                frequencies, ends[0] * RPM, ends[1] * RPM, label=kind, color=colour_of(kinds, kind)
            )
        speeds = _corners(line, *ends)
        numbers = np.arange(1, harmonics + 1)
        axes.plot(speeds * RPM, np.outer(line.at(speeds), numbers), color=GREY, lw=0.8)
        for h, place in _label_places(line, *ends, top, numbers):
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
            xlim=[end * RPM for end in ends],
            ylim=(0.0, top),
            xlabel=_speed_label(scene),
            ylabel="frequency [Hz]",
            title=f"{scene.name}: natural frequencies at mean mesh stiffness\n",
        )
        figure.legend(loc="outside lower center", ncols=len(kinds) + 2)
    return figure


def _corners(line: MeshLine, lowest: float, highest: float) -> np.ndarray:
    """Speeds [rad/s] between which the mesh frequency is straight: both ends, and where it is 0."""
    zero = line.speed(0.0)
    return np.array([lowest, zero, highest] if lowest < zero < highest else [lowest, highest])


def _speed_label(scene: Scene) -> str:
    second = scene.operating_point.second_input_speed * RPM
    beside = f" with the second one at {second:g} rpm" if second else ""
    return f"speed of the first motor{beside} [rpm]"


def _label_places(
    line: MeshLine, lowest: float, highest: float, top: float, numbers: np.ndarray
) -> list[tuple[int, tuple[float, float]]]:
    """Where the lines of the harmonics leave the picture for the last time, apart by a label.

    Args:
        line: mesh frequency.
        lowest: lowest speed of the picture [rad/s].
        highest: highest speed of the picture [rad/s].
        top: highest frequency of the picture [Hz].
        numbers: numbers of the harmonics, ascending.

    Returns:
        Harmonics with places from left to right and bottom to top of the picture, 0 to 1; without
        lines that are above the picture at all speeds.
    """
    heights = numbers * line.at(np.array(highest)) / top
    right = [int(h) for h in numbers[heights <= 1.0]]
    left = {}  # speed at which a line rises through the upper edge
    for h in numbers[heights > 1.0].tolist():
        through = [speed for s in (-top, top) if lowest < (speed := line.speed(s / h)) < highest]
        if through:
            left[h] = (max(through) - lowest) / (highest - lowest)
    above = _apart(list(left.values())[::-1], LABEL_WIDTH)[::-1]
    beside = _apart(heights[heights <= 1.0].tolist(), LABEL_HEIGHT)
    places = [(1.0, y) for y in beside] + [(x, 1.0) for x in above]
    return list(zip([*right, *left], places, strict=True))


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
