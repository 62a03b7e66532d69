"""Where each mesh stands in its cycle: which teeth are in contact, and where on their path.

A mesh cycle is the passage of one tooth. The rigid frame gives whole turns as integers, so cycles
stay exact however long the gearbox turns; whole cycles are counted modulo the teeth of a gear.
"""

from __future__ import annotations

import math
from fractions import Fraction

from .._core import Load, Train


def turns_per_cycle(train: Train) -> Fraction:
    """Turns of the first motor in a mesh cycle, the others at rest."""
    return Fraction(int(train.cycles_denominator[0]), int(train.cycles_numerator[0]))


def common_cycles(train: Train, load: Load) -> int:
    """Mesh cycles until faulty teeth, errors of form and fluctuation come round all together.

    0 if never: a train with two motors.
    """
    if train.axes > 1:
        return 0
    periods = [int(teeth) for teeth in train.fault_teeth[: train.faults]]
    for kind, lines in enumerate(train.lines):
        periods += [int(period) for period in train.line_period[kind, :lines]]
    if load.ripple != 0.0:
        periods.append((int(load.ripple_order) * turns_per_cycle(train)).denominator)
    return math.lcm(*periods)
