"""Style of the plots: colours that colour-blind people can distinguish, thin axes, no frames."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import AbstractContextManager
from pathlib import PurePath
from typing import Any, Literal

import matplotlib
from cycler import cycler
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter

# Okabe and Ito 2008.
BLUE, ORANGE, GREEN, PINK = "#0072B2", "#D55E00", "#009E73", "#CC79A7"
SKY, AMBER, GREY = "#56B4E9", "#E69F00", "#8C8C8C"
CYCLE = (BLUE, ORANGE, GREEN, PINK, AMBER, SKY)

WIDTH = 8.0  # [in]
DOTS_PER_INCH = 100
FINE = 300  # dots per inch of raster parts in a vector drawing
LEAST_SPAN = 1e-3  # smallest relative span of an axis
FORMATS = (".png", ".svg", ".pdf")
# Metadata to omit, so that files do not depend on the time of writing.
_MOMENT: dict[str, dict[str, Any]] = {
    ".png": {"Software": None},
    ".svg": {"Date": None},
    ".pdf": {"CreationDate": None},
}

_STYLE: Any = {
    "font.size": 9.5,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.linewidth": 0.7,
    "axes.titlesize": 10,
    "axes.titlelocation": "left",
    "axes.formatter.useoffset": False,  # 99.0281, not 1e-5 and +9.9028e1
    "axes.prop_cycle": cycler(color=CYCLE),
    "lines.linewidth": 1.5,
    "lines.markersize": 4.5,
    "legend.frameon": False,
    "legend.fontsize": 8.5,
    "xtick.direction": "out",
    "savefig.dpi": DOTS_PER_INCH,
    "pdf.fonttype": 42,  # text stays text
    "svg.hashsalt": "planetary_twin",  # reproducible names in the file
}


def applied() -> AbstractContextManager[None]:
    """Context in which figures have this style."""
    return matplotlib.rc_context(_STYLE)


def panels(
    count: int = 1, height: float = 2.9, columns: int | None = None
) -> tuple[Figure, list[Axes]]:
    """A figure with several axes.

    Args:
        count: number of axes.
        height: height of a row [in].
        columns: number of columns; None places all axes in one row.
    """
    columns = columns or count
    rows = -(-count // columns)
    figure = Figure(figsize=(WIDTH, rows * height), layout="constrained")
    axes = list(figure.subplots(rows, columns, squeeze=False).flat)
    for spare in axes[count:]:
        spare.remove()
    return figure, axes[:count]


def colour_of(names: Sequence[str], name: str) -> str:
    """The colour of one of several names.

    Args:
        names: names of all curves.
        name: name of the curve.
    """
    return CYCLE[names.index(name) % len(CYCLE)]


def drawing(axes: Axes) -> Axes:
    """Axes for a drawing to scale: no frame, no ticks.

    Args:
        axes: axes to change.
    """
    axes.set_aspect("equal")
    axes.set_axis_off()
    return axes


def logarithmic(axes: Axes, name: Literal["x", "y"]) -> None:
    """Make one axis logarithmic, with numbers without exponents.

    Args:
        axes: axes to change.
        name: name of the axis.
    """
    axes.set(**{f"{name}scale": "log"})
    axis = axes.xaxis if name == "x" else axes.yaxis
    axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))


def widen(axes: Axes) -> None:
    """Give the vertical axis a minimum relative span; smaller variations are numerical errors.

    Args:
        axes: axes to change.
    """
    low, high = axes.get_ylim()
    lacking = LEAST_SPAN * max(abs(low), abs(high)) - (high - low)
    if lacking > 0.0:
        axes.set_ylim(low - 0.5 * lacking, high + 0.5 * lacking)


def save(figure: Figure, path: str, dots_per_inch: int = DOTS_PER_INCH) -> None:
    """Write a picture reproducibly, in the format of the suffix.

    Args:
        figure: figure to write.
        path: path of the file; its suffix is one of FORMATS.
        dots_per_inch: resolution of a .png file.

    Raises:
        ValueError: the suffix is not one of FORMATS.
        OSError: the file cannot be written.
    """
    suffix = PurePath(path).suffix
    if suffix not in FORMATS:
        raise ValueError(f"must end in {', '.join(FORMATS)}")
    dots = dots_per_inch if suffix == ".png" else FINE
    with applied():
        figure.savefig(path, metadata=_MOMENT[suffix], dpi=dots)


def remark(figure: Figure, text: str) -> None:
    """A line below the picture.

    Args:
        figure: figure to change.
        text: text of the line.
    """
    figure.supxlabel(text, x=0.99, ha="right", fontsize=8.0, color=GREY)
