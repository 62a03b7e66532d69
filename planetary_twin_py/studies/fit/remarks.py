"""What whoever reads an estimate must know of it, in lines."""

from __future__ import annotations

from collections.abc import Iterator

from .identify import Identified
from .parameter import Parameter


def remarks(found: Identified) -> Iterator[str]:
    """What the stretch does not tell, what stands at its bound, and what the model misses."""
    estimate, parameters = found.estimate, found.parameters
    for members in estimate.untold:
        names = [parameters[k].name for k in members]
        if len(members) > 1:
            yield (
                f"{' and '.join(names)}: not told apart by this stretch: a change of one undoes "
                "that of another; observe more, or free fewer"
            )
            continue
        low, high, _ = estimate.intervals[members[0]]
        unit = parameters[members[0]].unit
        yield (
            f"{names[0]}: not told by this stretch: {_reason(found, names[0])}; any value from "
            f"{low:.3g} to {high:.3g} {unit}".rstrip()
            + " gives the same"
        )
    for k, parameter in enumerate(parameters):
        if estimate.told(k) and estimate.at_bound[k]:
            yield _at_end(parameter, float(estimate.unbounded[k]))
    if found.lacking is not None:
        field, value, unit, left = found.lacking
        yield (
            f"the model lacks a loss: {field} = {value:.3g} {unit} would lower the sum of squares "
            f"from {found.sum:.3g} to {left:.3g} (linear estimate); free it too"
        )
    if estimate.excess > 1.0:
        yield (
            "the model misses the recording by more than its noise: the sum of squares is "
            f"{estimate.excess:.3g} times what noise leaves; intervals are widened for it"
        )
    for readings, noise in zip(found.yardstick.recorded, found.yardstick.noise, strict=True):
        if noise.correlation > 0.0:
            yield (
                f"{readings.name}: successive readings are not independent: they correlate by "
                f"{noise.correlation:.2g}; intervals are widened for it"
            )
    yield from found.stretch.remarks


def _at_end(parameter: Parameter, unbounded: float) -> str:
    end = parameter.low if unbounded < parameter.low else parameter.high
    return (
        f"{parameter.name}: stands at the end of its range, {end:.3g} {parameter.unit}".rstrip()
        + f"; without the range it would be {unbounded:.3g} (linear estimate)"
    )


def _reason(found: Identified, name: str) -> str:
    if name == "backlash" and found.contact_fraction == 1.0:
        return "teeth never part (contact_fraction = 1)"
    if found.estimate.excess > 1.0:
        return "no reading changes with it by as much as the model misses the recording"
    return "no reading changes with it by more than its noise"
