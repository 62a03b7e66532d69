"""`planetary-twin fit` of the operating points of a recording."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from ..terminal.messages import warn
from ..terminal.names import shown
from ..text.finite import finite
from ..units.engineering import percent
from ._fitted import Fitted, Part, parameter_figures, print_fit

if TYPE_CHECKING:
    from pathlib import Path

    from rich.console import Console

    from ..plots.fit_report import Report
    from ..studies.fit.identify import Identified, Search


def fit_points(
    console: Console, file: Path, namespace: str | None, search: Search, part: Part
) -> Fitted:
    """Fit a scene to the operating points of a recording, and print the estimates.

    Args:
        console: console to print on.
        file: path of the recording.
        namespace: of the gearbox, if the recording has several.
        search: free fields, observed quantities and noise.
        part: of the recording.

    Raises:
        ValueError: a name or value is invalid, or the recording has no such part.
        ArithmeticError: the part cannot be simulated.
        OSError: the file cannot be read.
    """
    from ..studies.fit.identify import identify
    from ..studies.fit.remarks import remarks

    with console.status("simulating") as status:
        found = identify(
            file, search, namespace, part.begin, part.end,
            report=lambda count: status.update(f"{count} simulations"),
            hold_out=part.hold_out,
        )  # fmt: skip
    warnings = list(remarks(found))
    _print(console, found)
    warn(warnings)

    def report() -> Report:
        from ..plots.fit_report import report_of_points

        return report_of_points(found)

    return Fitted(_figures(found) | {"remarks": warnings}, report)


def _print(console: Console, found: Identified) -> None:
    excerpt, estimate = found.excerpt, found.estimate
    sources = []
    for k, (low, _, profiled) in enumerate(estimate.intervals):
        source = (
            ("profile" if profiled else "curvature")
            if estimate.identifiable(k)
            else ("combination only" if math.isnan(low) else "search range")
        )
        sources.append(source)
    title = f"{shown(excerpt.scene.name)}, {excerpt.start:g} to {excerpt.end:g} s"
    print_fit(console, title, found.parameters, estimate, found.confidence, sources)
    for one in found.predictions:
        console.print(
            f"held out: {one.name} at {len(one.measured)} operating points: rms error "
            f"{percent(one.rms, 3)}, {100.0 * one.inside:.3g} % within their "
            f"{100.0 * found.confidence:g} % intervals",
            highlight=False,
        )
    console.print(f"{found.simulations} simulations in {found.wall_time:.1f} s", highlight=False)


def _figures(found: Identified) -> dict[str, Any]:
    """Results for `--json`; "told" and "untold" are deprecated keys."""
    estimate = found.estimate
    parameters = parameter_figures(found.parameters, estimate)
    for one, interval in zip(parameters.values(), estimate.intervals, strict=True):
        one |= {"told": one["identifiable"], "profiled": interval.profiled}
    groups = [[found.parameters[k].name for k in group] for group in estimate.not_identifiable]
    return {
        "parameters": parameters,
        "confidence": found.confidence,
        "correlation": [[finite(value) for value in row] for row in estimate.correlation],
        "not_identifiable": groups,
        "untold": groups,
        "excess": estimate.excess,
        "noise": {
            readings.name: finite(float(noise.reading.max()))
            for readings, noise in zip(found.weighted.recorded, found.weighted.noise, strict=True)
        },
        "predictions": {
            one.name: {
                "measured": one.measured.tolist(),
                "predicted": one.predicted.tolist(),
                "reach": one.reach.tolist(),
                "rms": finite(one.rms),
                "inside": one.inside,
            }
            for one in found.predictions
        },
        "contact_fraction": found.contact_fraction,
        "from_s": found.excerpt.start,
        "to_s": found.excerpt.end,
        "simulations": found.simulations,
        "wall_time_s": found.wall_time,
    }
