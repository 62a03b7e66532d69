"""Figures of a study: curves, small multiples or a map."""

from __future__ import annotations

from collections.abc import Sequence
from textwrap import fill
from typing import TYPE_CHECKING, NamedTuple

import matplotlib
import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import to_hex
from matplotlib.figure import Figure

from ..studies.plan import BIFURCATION
from ..units.catalogue import AXES_RESULTS, STUDY_RESULTS
from .bifurcation import bifurcation_diagram
from .clipped import LEGEND, clipped_points, mark
from .maps import draw_map
from .quantity import Column, columns, find
from .sampled import histogram_diagram, points_diagram
from .stribeck import stribeck_diagram
from .style import CYCLE, GREY, applied, logarithmic, panels, remark, widen

if TYPE_CHECKING:
    import pyarrow as pa

KINDS = ("curves", "map", "points", "histogram", "stribeck")
MANY = 6  # values of each of two fields for a map
MOST_PANELS = 12
MOST_FIELDS = 3  # that curves and panels distinguish
MOST_LINES = 12
SHADES = "viridis"
LABEL = 34  # characters per line of the label of a vertical axis


class Choice(NamedTuple):
    """Roles of the columns in a figure."""

    x: Column
    measures: tuple[Column, ...]
    by: Column | None
    panel: Column | None  # a panel for each of its values
    is_map: bool
    clipped: np.ndarray  # points with viscous friction clipped to zero (bool)


def plot_study(
    table: pa.Table,
    x: str | None = None,
    measures: Sequence[str] = (),
    by: str | None = None,
    kind: str | None = None,
) -> Figure:
    """Draw the table of a study.

    By default the figure depends on the number of fields that vary. One: curves over it. Two: a
    curve for each value of the second, or a map if both have many values. Three: a panel for each
    value of the third. More: the points over each of them. Failed points are omitted, and the
    figure states their number.

    Args:
        table: table of a sweep or a bifurcation.
        x: column of the horizontal axis.
        measures: columns to draw, in separate panels; if empty, the first measure.
        by: field distinguished by colour; in a map, the vertical axis.
        kind: "curves", "map", "points", "histogram" or "stribeck".

    Returns:
        The figure, in customary units.

    Raises:
        ValueError: a column does not exist, or there is nothing to draw.
    """
    known, (completed, failed) = columns(table), _without_failures(table)
    if kind is not None and kind not in KINDS:
        raise ValueError(f"kind = {kind!r}: must be one of {', '.join(KINDS)}")
    for name, role in [(x, "x"), (by, "by"), *((name, "y") for name in measures)]:
        if name is not None:
            find(known, name, role)
    if not len(completed):
        raise ValueError("all points of the table failed")
    known = columns(completed)
    with applied():
        if (table.schema.metadata or {}).get(b"study") == BIFURCATION.encode():
            figure = bifurcation_diagram(known, measures)
        elif kind == "stribeck":
            figure = stribeck_diagram(known)
        else:
            varying = [name for name in fields(table) if len(known[name].distinct) > 1]
            if kind is None and len({*varying, x, by} - {None, *measures}) > MOST_FIELDS:
                kind = "points"
            drawn = [known[name] for name in measures or (_first_measure(known),)]
            if kind == "histogram":
                figure = histogram_diagram(drawn)
            elif kind == "points":
                over = [name for name in ([x] if x else varying) if name not in measures]
                _check_panels(len(drawn) * len(over))
                figure = points_diagram([known[name] for name in over], drawn)
            else:
                figure = _draw(_choose(known, varying, (x, tuple(measures), by), kind))
        notes = [f"{failed} of {len(table)} points failed and are omitted"] if failed else []
        notes += [LEGEND] if clipped_points(known, len(completed)).any() else []
        if notes:
            remark(figure, "; ".join(notes))
    return figure


def fields(table: pa.Table) -> list[str]:
    """Names of the columns that the study varied."""
    other_columns = ("point", "failure", *STUDY_RESULTS, *AXES_RESULTS)
    return [name for name in table.column_names if name not in other_columns]


def failures(table: pa.Table) -> int:
    """Number of rows without results.

    Args:
        table: table of a study.
    """
    return len(table) - table["failure"].null_count if "failure" in table.column_names else 0


def _without_failures(table: pa.Table) -> tuple[pa.Table, int]:
    import pyarrow.compute as compute

    failed = failures(table)
    return (table.filter(compute.is_null(table["failure"])) if failed else table), failed


def _choose(
    known: dict[str, Column],
    varying: list[str],
    given: tuple[str | None, tuple[str, ...], str | None],
    kind: str | None,
) -> Choice:
    x, measures, by = given
    free = [name for name in varying if name not in (x, by, *measures)]
    x = x or _next_field(free, "x: no field of the table varies, name a column")
    chosen = tuple(known[name] for name in measures or (_first_measure(known),))
    if by is None and free:
        by = free.pop(0)
    panel = free.pop(0) if free else None
    if free:
        raise ValueError(
            f"{', '.join(free)}: more than three fields vary; fix all but three, or draw points"
        )
    second = known[by] if by else None
    is_map = kind == "map" or (kind is None and _fill_a_map(known[x], second))
    if is_map and (second is None or not (known[x].is_number and second.is_number)):
        raise ValueError("a map needs two numerical fields that vary")
    clipped = clipped_points(known, len(known[x].values))
    return Choice(known[x], chosen, second, known[panel] if panel else None, is_map, clipped)


def _next_field(free: list[str], lack: str) -> str:
    if not free:
        raise ValueError(lack)
    return free.pop(0)


def _first_measure(known: dict[str, Column]) -> str:
    for name in known:
        if name in STUDY_RESULTS:
            return name
    raise ValueError("y: no column is a result of a study, name columns")


def _fill_a_map(x: Column, by: Column | None) -> bool:
    if by is None or not (x.is_number and by.is_number):
        return False
    return min(len(x.distinct), len(by.distinct)) >= MANY


def _draw(choice: Choice) -> Figure:
    parts = [None] if choice.panel is None else list(choice.panel.distinct)
    places = [(measure, part) for measure in choice.measures for part in parts]
    _check_panels(len(places))
    most = 2 if choice.is_map else 3
    across = min(len(places) if len(parts) == 1 else len(parts), most)
    figure, panes = panels(len(places), 3.6 if len(places) == 1 else 2.9, across)
    limits = {m.name: (np.nanmin(m.values), np.nanmax(m.values)) for m in choice.measures}
    for axes, (measure, part) in zip(panes, places, strict=True):
        rows = np.full(len(choice.x.values), True)
        if choice.panel is not None:
            rows = choice.panel.values == part
            axes.set_title(f"{choice.panel.quantity.title} {choice.panel.text(part)}")
        if choice.is_map and choice.by is not None:
            draw_map(axes, (choice.x, choice.by, measure), rows, limits[measure.name])
            hollow = rows & choice.clipped
            mark(axes, choice.x.values[hollow], choice.by.values[hollow], GREY)
        else:
            _curves(axes, choice, measure, rows)
    if choice.panel is not None and not choice.is_map:
        _share_limits(panes, len(parts))
    lines = {str(line.get_label()): line for axes in panes for line in axes.get_lines()}
    if choice.by is not None and not choice.is_map:
        figure.legend(
            handles=list(lines.values()),
            title=choice.by.label,
            loc="outside right upper",
        )
    return figure


def _check_panels(count: int) -> None:
    if not 1 <= count <= MOST_PANELS:
        raise ValueError(f"{count} panels: must be within 1 and {MOST_PANELS}; draw other columns")


def _share_limits(panes: list[Axes], count: int) -> None:
    """Give every group of `count` panels, which show one measure, the same limits."""
    for first in range(0, len(panes), count):
        group = panes[first : first + count]
        lows, highs = zip(*(axes.get_ylim() for axes in group), strict=True)
        for axes in group:
            axes.set_ylim(min(lows), max(highs))


def _curves(axes: Axes, choice: Choice, measure: Column, rows: np.ndarray) -> None:
    x, by = choice.x, choice.by
    groups = [None] if by is None else list(by.distinct)
    if len(groups) > MOST_LINES:
        raise ValueError(
            f"{by.name if by else ''}: {len(groups)} curves: must be at most {MOST_LINES}; "
            "choose another field with by, or a map"
        )
    for n, value in enumerate(groups):
        selected = rows if by is None else rows & (by.values == value)
        order = np.argsort(x.values[selected], kind="stable") if x.is_number else slice(None)
        colour = CYCLE[n] if len(groups) <= len(CYCLE) else _shade(n, len(groups))
        hollow = selected & choice.clipped
        axes.plot(
            x.values[selected][order],
            measure.values[selected][order],
            "o-" if x.is_number else "o",
            color=colour,
            label="" if by is None else by.text(value).removesuffix(f" {by.quantity.unit}"),
            markersize=3.0 if x.is_number else None,
        )
        mark(axes, x.values[hollow], measure.values[hollow], colour)
    if x.is_logarithmic:
        logarithmic(axes, "x")
    axes.set_xlabel(x.label)
    axes.set_ylabel(fill(measure.label, LABEL))
    axes.margins(x=0.03)
    widen(axes)


def _shade(n: int, count: int) -> str:
    return to_hex(matplotlib.colormaps[SHADES](0.9 * n / (count - 1)))
