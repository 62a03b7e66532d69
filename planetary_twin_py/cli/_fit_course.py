"""`planetary-twin fit` of a manoeuvre in a table or a MAT file."""

from __future__ import annotations

import math
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..terminal.messages import warn
from ..terminal.names import shown
from ..text.finite import finite
from ._fitted import Fitted, Part, parameter_figures, print_fit

if TYPE_CHECKING:
    from rich.console import Console

    from ..following.sensors import Sensors
    from ..plots.fit_report import Report
    from ..studies.fit.fit_course import FittedCourse


def fit_manoeuvre(
    console: Console,
    file: Path,
    scene: str | None,
    free: Mapping[str, str],
    part: Part,
    sensors: Sensors,
) -> Fitted:
    """Fit a scene to a manoeuvre, and print the estimates.

    Args:
        console: console to print on.
        file: path of the file, see `read_course`.
        scene: name or file of the scene.
        free: initial values by name of the free fields; empty: the value in the scene.
        part: of the manoeuvre.
        sensors: accuracy, names of columns, and factors on readings.

    Raises:
        ValueError: a name, a value or the file is invalid.
        ArithmeticError: the scene cannot be simulated.
        OSError: the file cannot be read.
    """
    from ..studies.fit.fit_course import course_remarks, fit_course
    from ..terminal.settings import changed_scene

    if scene is None:
        raise ValueError(f"--scene: required for a table of readings over time, {file}")
    begin, end = part.begin, part.end
    limits = -math.inf if begin is None else begin, math.inf if end is None else end
    start = {name: value for name, value in free.items() if value}
    with console.status("simulating") as status:
        found = fit_course(
            file, changed_scene(scene, {}), tuple(free), start, limits, part.hold_out,
            lambda count: status.update(f"{count} simulated points"), sensors,
        )  # fmt: skip
    _print(console, found)
    warnings = list(course_remarks(found))
    warn(warnings)

    def report() -> Report:
        from ..plots.fit_report import report_of_course

        return report_of_course(found)

    return Fitted(_figures(found) | {"remarks": warnings}, report)


def _print(console: Console, found: FittedCourse) -> None:
    from ..studies.fit.fit_course import CONFIDENCE

    first, last = found.course.time[[0, -1]]
    title = f"{shown(found.scene.name)}, {first:.4g} to {last:.4g} s"
    print_fit(console, title, found.parameters, found.estimate, CONFIDENCE)
    if found.held_out is not None:
        console.print(
            f"held out: {len(found.held_out.time)} bins, {100.0 * found.inside:.3g} % within their "
            "95 % intervals",
            highlight=False,
        )
    console.print(
        f"{found.simulations} simulated points, {found.processor_time:.1f} s of processor time for "
        f"{last - first:.1f} s of data",
        highlight=False,
    )


def _figures(found: FittedCourse) -> dict[str, Any]:
    """Results for `--json`."""
    return {
        "parameters": parameter_figures(found.parameters, found.estimate),
        "noise": found.noise,
        "correlation": found.correlation,
        "inside": finite(found.inside),
        "simulations": found.simulations,
        "processor_time_s": found.processor_time,
    }
