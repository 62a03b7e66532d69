"""Position of the meshes in their cycles.

A mesh cycle is the passage of one tooth. The rigid frame gives whole turns as integers, so cycles
are exact for any run time. Whole cycles are counted modulo the number of teeth of a gear.
"""

from __future__ import annotations

import math
from fractions import Fraction

from .._core import Operation, Train


def turns_per_cycle(train: Train) -> Fraction:
    """Turns of the first motor in one mesh cycle while the others are at rest."""
    return Fraction(int(train.cycle.denominator[0]), int(train.cycle.numerator[0]))


def common_cycles(train: Train, operation: Operation) -> int:
    """Mesh cycles after which faults, errors of form, torque ripple and weight repeat together.

    0 for a train with two motors, which never repeats, or with pits in bearings, whose elements
    return to a place after very long times.
    """
    if train.axes > 1 or train.moving.pits > 0:
        return 0
    periods = [int(teeth) for teeth in train.faults.teeth[: train.faults.count]]
    for kind, lines in enumerate(train.errors.lines):
        periods += [int(period) for period in train.errors.period[kind, :lines]]
    if operation.ripple != 0.0:
        periods.append((int(operation.ripple_order) * turns_per_cycle(train)).denominator)
    if train.moving.gravity != 0.0:
        ratio = Fraction(int(train.moving.turn_numerator[0]), int(train.moving.turn_denominator[0]))
        periods.append((ratio * turns_per_cycle(train)).denominator)  # whole turns of the carrier
    return math.lcm(*periods)
