"""A report of a fit: estimates, remarks and pictures, as Markdown or one HTML file."""

from __future__ import annotations

import base64
import html
import io
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from ..studies.fit.estimate import Estimate
from ..studies.fit.fit_course import FittedCourse, course_remarks
from ..studies.fit.identify import Identified
from ..studies.fit.parameter import Parameter
from ..studies.fit.remarks import remarks
from ..text.intervals import interval_text
from ..units.engineering import percent
from .fit import course_figure, points_figure
from .style import applied, save

if TYPE_CHECKING:
    from matplotlib.figure import Figure

SUFFIXES = (".md", ".html")


class Report(NamedTuple):
    """Contents of a report."""

    title: str
    parameters: Sequence[Parameter]
    estimate: Estimate
    confidence: float
    facts: Sequence[str]
    """Sentences below the table."""
    remarks: Sequence[str]
    figures: Sequence[Figure]


def report_of_course(found: FittedCourse) -> Report:
    """Report on a manoeuvre.

    Args:
        found: result of `fit_course`.
    """
    held_out = None
    facts = [
        f"{len(found.course.time)} bins from {found.course.time[0]:.4g} to "
        f"{found.course.time[-1]:.4g} s; residuals {found.noise:.3g} N m rms, with a correlation "
        f"of {found.correlation:.2f} between successive bins.",
        f"{found.simulations} simulated points, {found.processor_time:.1f} s of processor time.",
    ]
    if found.held_out is not None and found.predicted is not None and found.reach is not None:
        other = found.held_out
        held_out = (other.time, other.input_torque, found.predicted, found.reach)
        facts.append(
            f"Held out: {len(other.time)} bins from {other.time[0]:.4g} to {other.time[-1]:.4g} s, "
            f"{100.0 * found.inside:.3g} % within their 95 % intervals."
        )
    with applied():
        figure = course_figure(
            found.course.time, found.course.input_torque, found.simulated, held_out
        )
    return Report(
        f"Fit of {found.scene.name} to a manoeuvre", found.parameters, found.estimate, 0.95, facts,
        list(course_remarks(found)), [figure],
    )  # fmt: skip


def report_of_points(found: Identified) -> Report:
    """Report on operating points of a recording.

    Args:
        found: result of `identify`.
    """
    predictions = {prediction.name: prediction for prediction in found.predictions}
    facts = [
        f"{found.excerpt.start:g} to {found.excerpt.end:g} s; sum of squares {found.sum:.4g}, "
        f"{found.estimate.excess:.3g} times the expected one.",
        f"{found.simulations} simulations in {found.wall_time:.1f} s.",
    ]
    facts += [
        f"Held out: {prediction.name} at {len(prediction.measured)} operating points, rms error "
        f"{percent(prediction.rms, 3)}, {100.0 * prediction.inside:.3g} % within their intervals."
        for prediction in found.predictions
    ]
    figures = []
    with applied():
        for readings, residuals in zip(found.weighted.recorded, found.residuals, strict=True):
            matching = predictions.get(readings.name)
            held_out = (
                None
                if matching is None
                else (matching.predicted - matching.measured, matching.reach)
            )
            figures.append(points_figure(readings.name, residuals, held_out))
    return Report(
        f"Fit of {found.excerpt.scene.name}", found.parameters, found.estimate, found.confidence,
        facts, list(remarks(found)), figures,
    )  # fmt: skip


def write_report(path: Path, report: Report) -> None:
    """Write a report.

    Args:
        path: NAME.md, with its pictures beside it as NAME-1.png, ..., or NAME.html, with its
            pictures in it.
        report: contents.

    Raises:
        ValueError: the name has another ending.
        OSError: a file cannot be written.
    """
    if path.suffix not in SUFFIXES:
        raise ValueError(f"must end in {' or '.join(SUFFIXES)}")
    rows = list(_rows(report))
    if path.suffix == ".html":
        path.write_text(_html(report, rows), "utf-8")
        return
    lines = [f"# {report.title}", "", "| " + " | ".join(rows[0]) + " |", "|---|---|---|---|"]
    lines += ["| " + " | ".join(row) + " |" for row in rows[1:]]
    lines += ["", *report.facts, ""]
    lines += [f"- warning: {line}" for line in report.remarks]
    for number, figure in enumerate(report.figures, 1):
        picture = path.with_name(f"{path.stem}-{number}.png")
        with applied():
            save(figure, str(picture))
        lines += ["", f"![Picture {number}]({picture.name})"]
    path.write_text("\n".join(lines) + "\n", "utf-8")


def _rows(report: Report) -> Sequence[tuple[str, str, str, str]]:
    rows = [("field", "estimate", f"{100.0 * report.confidence:g} % interval", "unit")]
    for k, parameter in enumerate(report.parameters):
        low, high, _ = report.estimate.intervals[k]
        known = report.estimate.identifiable(k)
        value, span = interval_text(report.estimate.values[k], low, high)
        shown = value if known else "not identifiable"
        rows.append((parameter.name, shown, span, parameter.unit or "-"))
    return rows


def _html(report: Report, rows: Sequence[tuple[str, str, str, str]]) -> str:
    def row(cells: tuple[str, str, str, str], kind: str) -> str:
        return "<tr>" + "".join(f"<{kind}>{html.escape(cell)}</{kind}>" for cell in cells) + "</tr>"

    title = html.escape(report.title)
    parts = [
        "<!doctype html>", '<html lang="en">', f'<meta charset="utf-8"><title>{title}</title>',
        "<style>body{font:16px sans-serif;max-width:55rem;margin:2rem auto}"
        "td,th{padding:.2rem .8rem;text-align:right}</style>",
        f"<h1>{title}</h1>", "<table>", row(rows[0], "th"),
        *(row(cells, "td") for cells in rows[1:]), "</table>",
        *(f"<p>{html.escape(fact)}</p>" for fact in report.facts),
        *(f"<p><b>warning:</b> {html.escape(line)}</p>" for line in report.remarks),
    ]  # fmt: skip
    for number, figure in enumerate(report.figures, 1):
        stream = io.BytesIO()
        figure.savefig(stream, format="png", metadata={"Software": None})
        data = base64.b64encode(stream.getvalue()).decode()
        parts.append(f'<p><img alt="Picture {number}" src="data:image/png;base64,{data}"></p>')
    return "\n".join(parts) + "\n</html>\n"
