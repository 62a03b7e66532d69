"""What whoever reads an estimate must know of it, in lines."""

from __future__ import annotations

from collections.abc import Iterator

from .identify import Identified


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
            yield f"{parameter.name}: at the bound of its range, {estimate.values[k]:.3g}"
    if estimate.excess > 1.0:
        yield (
            "the model misses the recording by more than its noise: the sum of squares is "
            f"{estimate.excess:.3g} times what noise leaves; intervals are widened for it"
        )
    yield from found.stretch.remarks


def _reason(found: Identified, name: str) -> str:
    if name == "backlash" and found.contact_fraction == 1.0:
        return "teeth never part (contact_fraction = 1)"
    return "no reading changes with it by more than its noise"
