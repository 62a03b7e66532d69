"""Campbell diagram: natural frequencies, mesh harmonics and their crossings."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ..modal.campbell import HARMONICS, MeshLine, Resonance, mesh_line, shaft_orders
from ..modal.excitation import EXCITED
from ..modal.modes import NaturalModes
from ..scene import Scene
from .style import GREY, applied, colour_of, panels

RPM = 30.0 / np.pi  # per rad/s
LABEL_HEIGHT, LABEL_WIDTH = 0.045, 0.02  # of a digit over those of the picture
COLUMN, ROW = 9.0, 12.0  # [pt] from a label at an edge to the next one outwards
GAP = 3.0  # [pt] from an edge to a label
DASHES = ("--", ":", "-.")
SMALLEST, LARGEST = 8.0, 40.0  # [pt^2] circle of a weak crossing, and what is added to the largest
MARGIN = 1.1  # highest frequency shown/highest natural frequency


def campbell_diagram(
    scene: Scene,
    modes: NaturalModes,
    found: tuple[Resonance, ...],
    highest_speed: float,
    model: str = "torsional",
) -> Figure:
    """Draw frequencies against the speed of the first motor.

    Args:
        scene: gives the mesh frequency, the speed of a second motor, and the title; the harmonics
            drawn are the first five and those of `found`.
        modes: modes at mean mesh stiffness; modes of one kind have the same colour.
        found: crossings to mark, from `resonances`.
        highest_speed: end of the speed axis [rad/s]; its start is that of `MeshLine.lowest_speed`.
        model: of the modes, see `natural_modes`; for the title.
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
        numbers = np.array(sorted({*range(1, HARMONICS + 1), *(r.harmonic for r in found)}))
        axes.plot(speeds * RPM, np.outer(line.at(speeds), numbers), color=GREY, lw=0.8)
        for k, (name, order) in enumerate(shaft_orders(scene).items()):
            corners = _corners(order, *ends)
            axes.plot(corners * RPM, order.at(corners), color=GREY, ls=DASHES[k], label=name)
        labels = _labels(line, *ends, top, numbers)
        _annotate(axes, labels)
        _mark(axes, [r for r in found if r.excitation == EXCITED], "excited by a mesh harmonic")
        if others := [r for r in found if r.excitation != EXCITED]:
            _mark(axes, others, "met, not excited", fill="white")
        axes.set(
            xlim=[end * RPM for end in ends],
            ylim=(0.0, top),
            xlabel=_speed_label(scene),
            ylabel="frequency [Hz]",
        )
        axes.set_title(
            f"{scene.name}, {model} model: natural frequencies at mean mesh stiffness",
            pad=2.0 * ROW + max((label.offset[1] for label in labels), default=0.0) - GAP,
        )
        figure.legend(loc="outside lower center", ncols=3)
    return figure


def _annotate(axes: Axes, labels: Iterable[_Label]) -> None:
    """Write the numbers of the harmonics."""
    for label in labels:
        axes.annotate(
            f"{label.harmonic}",
            label.place,
            label.offset,
            xycoords="axes fraction",
            textcoords="offset points",
            ha="left" if label.offset[0] else "center",
            va="baseline" if label.offset[1] else "center",
            color=GREY,
            annotation_clip=False,
        )


def _corners(line: MeshLine, lowest: float, highest: float) -> np.ndarray:
    """Speeds [rad/s] between which the mesh frequency is straight: both ends, and where it is 0."""
    zero = line.speed(0.0) if line.slope else lowest
    return np.array([lowest, zero, highest] if lowest < zero < highest else [lowest, highest])


def _speed_label(scene: Scene) -> str:
    second = scene.operating_point.second_input_speed * RPM
    beside = f" with the second one at {second:g} rpm" if second else ""
    return f"speed of the first motor{beside} [rpm]"


class _Label(NamedTuple):
    """Number of a harmonic where its line leaves the picture for the last time."""

    harmonic: int
    place: tuple[float, float]
    """From left to right and bottom to top of the picture, 0 to 1."""
    offset: tuple[float, float]
    """Outwards, at right angles to the edge [pt]."""


def _labels(
    line: MeshLine, lowest: float, highest: float, top: float, numbers: np.ndarray
) -> list[_Label]:
    """Labels at the right and the upper edge, each at its own line.

    Args:
        line: mesh frequency.
        lowest: lowest speed of the picture [rad/s].
        highest: highest speed of the picture [rad/s].
        top: highest frequency of the picture [Hz].
        numbers: numbers of the harmonics, ascending.

    Returns:
        The labels; none of lines that are above the picture at all speeds.
    """
    beside, above = {}, {}  # places on the edges, ascending
    for h, height in zip(numbers.tolist(), numbers * line.at(np.array(highest)) / top, strict=True):
        if height <= 1.0:
            beside[h] = float(height)
    for h in numbers.tolist()[::-1]:
        through = [speed for s in (-top, top) if lowest < (speed := line.speed(s / h)) < highest]
        if h not in beside and through:
            above[h] = (max(through) - lowest) / (highest - lowest)
    columns = _rows([*beside.values()], LABEL_HEIGHT)
    rows = _rows([*above.values()], LABEL_WIDTH)
    return [
        *(_Label(h, (1.0, y), (GAP + COLUMN * k, 0.0))
          for (h, y), k in zip(beside.items(), columns, strict=True)),
        *(_Label(h, (x, 1.0), (0.0, GAP + ROW * k))
          for (h, x), k in zip(above.items(), rows, strict=True)),
    ]  # fmt: skip


def _rows(places: list[float], gap: float) -> list[int]:
    """Row of each of the ascending places, so that those in one row are at least `gap` apart."""
    last: list[float] = []  # place in each row
    found = []
    for place in places:
        row = next((k for k, before in enumerate(last) if place - before >= gap), len(last))
        last[row : row + 1] = [place]
        found.append(row)
    return found


def _mark(axes: Axes, found: list[Resonance], label: str, fill: str = "black") -> None:
    """Draw circles with a colour inside where harmonics meet frequencies, larger with weight."""
    strongest = max((r.weight for r in found), default=0.0) or math.inf
    axes.scatter(
        [r.speed * RPM for r in found],
        [r.frequency for r in found],
        [SMALLEST + LARGEST * r.weight / strongest for r in found],
        facecolors=fill,
        edgecolors="black",
        label=label,
        zorder=3,
    )
