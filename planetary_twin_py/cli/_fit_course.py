"""`planetary-twin fit` of a manoeuvre in a table or a MAT file."""

from __future__ import annotations

import math
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING

from ..terminal.messages import remark
from ..terminal.names import shown
from ..text.finite import finite
from ._fitted import Fitted, Part, parameter_figures, print_fit

if TYPE_CHECKING:
    from rich.console import Console

    from ..following.sensors import Sensors
    from ..plots.fit_report import Report


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
    from ..studies.fit.fit_course import CONFIDENCE, course_remarks, fit_course
    from ..terminal.settings import changed_scene

    if scene is None:
        raise ValueError(f"--scene: required for a table of readings over time, {file}")
    limits = (
        -math.inf if part.begin is None else part.begin,
        math.inf if part.end is None else part.end,
    )
    start = {name: value for name, value in free.items() if value}
    with console.status("simulating") as status:
        found = fit_course(
            file, changed_scene(scene, {}), tuple(free), start, limits, part.hold_out,
            lambda count: status.update(f"{count} simulated points"), sensors,
        )  # fmt: skip
    course = found.course
    title = f"{shown(found.scene.name)}, {course.time[0]:.4g} to {course.time[-1]:.4g} s"
    print_fit(console, title, found.parameters, found.estimate, CONFIDENCE)
    if found.held_out is not None:
        console.print(
            f"held out: {len(found.held_out.time)} bins, {100.0 * found.inside:.3g} % within their "
            "95 % intervals",
            highlight=False,
        )
    console.print(
        f"{found.simulations} simulated points, {found.processor_time:.1f} s of processor time for "
        f"{course.time[-1] - course.time[0]:.1f} s of data",
        highlight=False,
    )
    warnings = list(course_remarks(found))
    for line in warnings:
        remark(f"warning: {line}")

    def report() -> Report:
        from ..plots.fit_report import report_of_course

        return report_of_course(found)

    figures = {
        "parameters": parameter_figures(found.parameters, found.estimate),
        "noise": found.noise,
        "correlation": found.correlation,
        "inside": finite(found.inside),
        "simulations": found.simulations,
        "processor_time_s": found.processor_time,
        "remarks": warnings,
    }
    return Fitted(figures, report)
