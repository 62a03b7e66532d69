"""Names a friction level that the readings hardly determine."""

from __future__ import annotations

from collections.abc import Iterator


def friction_remarks(low: float, value: float, high: float, teeth: float) -> Iterator[str]:
    """A line for a friction level whose interval has impossible values, or is as wide as the level.

    `teeth` is the loss torque of tooth friction in the scene at the input [N m].
    """
    if high < 0.0:
        yield (
            f"friction_level is below {high:.2g}, which is impossible: the signs of both torques "
            "or of both speeds may be reversed, or a torque has a wrong gain"
        )
    elif low < 0.0 or high - low >= value:
        impossible = ", of which values below 0 are impossible" if low < 0.0 else ""
        zero = teeth * (value - 1.0)
        yield (
            f"friction_level is {value:.2g}, with an interval of {low:.2g} to {high:.2g}"
            f"{impossible}: the readings hardly determine it; a zero of the torque sensors of "
            f"{zero:+.2g} N m at the input has the same effect as this difference from 1. Check "
            "the zeros without load, or let the torque reverse"
        )
