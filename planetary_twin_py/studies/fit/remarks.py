"""Warnings about an estimate."""

from __future__ import annotations

from collections.abc import Iterator

from ...checks.accuracy import course_warnings
from .identify import Identified
from .parameter import Parameter
from .readings import Array
from .residual_runs import count_runs


def remarks(found: Identified) -> Iterator[str]:
    """Warn about parameters that are not identifiable or at a bound, and about model errors."""
    estimate, parameters = found.estimate, found.parameters
    for members in estimate.not_identifiable:
        names = [parameters[k].name for k in members]
        if len(members) > 1:
            yield (
                f"{' and '.join(names)}: only a combination is identifiable from this excerpt: a "
                "change of one compensates a change of another; observe more, or free fewer"
            )
            continue
        low, high, _ = estimate.intervals[members[0]]
        unit = parameters[members[0]].unit
        yield (
            f"{names[0]}: not identifiable from this excerpt: {_reason(found, names[0])}; all "
            f"values from {low:.3g} to {high:.3g} {unit}".rstrip()
            + " fit equally"
        )
    for k, parameter in enumerate(parameters):
        if estimate.identifiable(k) and estimate.at_bound[k]:
            yield _at_end(parameter, float(estimate.unbounded[k]))
    if found.missing_loss is not None:
        field, value, unit, left = found.missing_loss
        yield (
            f"the model lacks a loss: {field} = {value:.3g} {unit} would reduce the sum of squares "
            f"from {found.sum:.3g} to {left:.3g} (linear estimate); free it too"
        )
    if estimate.excess > 1.0:
        yield (
            "the residuals are larger than the noise: the sum of squares is "
            f"{estimate.excess:.3g} times the expected one; intervals are widened accordingly"
        )
    for readings, noise in zip(found.weighted.recorded, found.weighted.noise, strict=True):
        if noise.correlation > 0.0:
            yield (
                f"{readings.name}: successive readings are correlated, with a coefficient of "
                f"{noise.correlation:.2g}; intervals are widened accordingly"
            )
    for readings, residuals in zip(found.weighted.recorded, found.residuals, strict=True):
        yield from _not_noise(readings.name, residuals)
    # Readings are means over intervals: impacts that amplify errors of single values do not matter.
    for line in course_warnings(found.course._replace(flank_events=0)):
        yield f"at the estimate, {line}"
    yield from found.excerpt.remarks


def _not_noise(name: str, residuals: Array) -> Iterator[str]:
    for channel, values in enumerate(residuals.T, 1):
        runs = count_runs(values)
        if runs is not None and not runs.noise:
            which = f"{name} of mesh {channel}" if residuals.shape[1] > 1 else name
            yield (
                f"{which}: the residuals of {len(values)} operating points are not noise: "
                f"{runs.runs} runs of one sign, {runs.expected:.0f} expected in random order; an "
                "effect that changes slowly with the operating point is not modelled"
            )


def _at_end(parameter: Parameter, unbounded: float) -> str:
    end = parameter.low if unbounded < parameter.low else parameter.high
    return (
        f"{parameter.name}: is at the end of its range, {end:.3g} {parameter.unit}".rstrip()
        + f"; without the range it would be {unbounded:.3g} (linear estimate)"
    )


def _reason(found: Identified, name: str) -> str:
    if name == "backlash" and found.contact_fraction == 1.0:
        return "teeth never separate (contact_fraction = 1)"
    if found.estimate.excess > 1.0:
        return "its effect on the readings is smaller than the residuals"
    return "its effect on the readings is smaller than their noise"
