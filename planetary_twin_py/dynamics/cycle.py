"""Where each mesh stands in its cycle: which teeth are in contact, and where on their path.

A mesh cycle is the passage of one tooth. The rigid frame gives whole turns as integers, so cycles
stay exact however long the gearbox turns; whole cycles are counted modulo the teeth of a gear.
"""

from __future__ import annotations

import math
from fractions import Fraction

import numpy as np

from .._compile import kernel
from .._records import AXES, Record
from .state import COAST_SIDE


@kernel
def cycle_shift(train: Record, x: np.ndarray) -> float:
    """Mesh cycles by which the train is ahead of the rigid frame."""
    return train.sun_advance * x[train.sun] + train.carrier_advance * x[train.carrier]


@kernel
def frame_cycle(train: Record, state: Record, modulus: int) -> float:
    """Mesh cycles of the rigid frame since the start, modulo `modulus`."""
    total = 0.0
    for a in range(AXES):
        period = train.cycles_denominator[a] * modulus
        whole = int(state.turns[a]) * train.cycles_numerator[a] % period
        total += whole / train.cycles_denominator[a] + train.cycles[a] * state.fraction[a]
    return total - modulus * math.floor(total / modulus)


@kernel
def counted_cycle(train: Record, state: Record, i: int, side: int, modulus: int) -> float:
    """Cycles since tooth pair 0 of mesh i was at the pitch point, modulo `modulus`."""
    cycle = frame_cycle(train, state, modulus) + cycle_shift(train, state.x)
    return cycle_on_side(train, i, side, cycle, modulus)


@kernel
def cycle_on_side(train: Record, i: int, side: int, cycle: float, modulus: int) -> float:
    """The same from the mesh `cycle` that the train has reached since the start.

    The coast flanks see the motion mirrored, half a pitch later.
    """
    cycle = side * (cycle - train.phase[i])
    if side == COAST_SIDE:
        cycle += 0.5
    return cycle - modulus * math.floor(cycle / modulus)


@kernel
def mesh_cycle(train: Record, state: Record, i: int, side: int) -> float:
    """Fraction of its cycle at which mesh i stands on one side, in [0, 1)."""
    return counted_cycle(train, state, i, side, 1)


@kernel
def find_segment(train: Record, kind: int, cycle: float, direction: float) -> int:
    """Segment of the table of tooth pairs at a fraction of the cycle; at an edge, the one ahead."""
    last = train.segments[kind] - 1
    segment = 0
    while segment < last and train.edge[kind, segment + 1] <= cycle:
        segment += 1
    if direction < 0.0 and cycle == train.edge[kind, segment]:
        segment = segment - 1 if segment > 0 else last
    return segment


@kernel
def nearest_to_segment(train: Record, kind: int, segment: int, cycle: float) -> float:
    """The representative of `cycle` modulo 1 that lies in or next to a segment."""
    middle = 0.5 * (train.edge[kind, segment] + train.edge[kind, segment + 1])
    return cycle - math.floor(cycle - middle + 0.5)


def turns_per_cycle(train: Record) -> Fraction:
    """Turns of the first motor in a mesh cycle, the others at rest."""
    return Fraction(int(train.cycles_denominator[0]), int(train.cycles_numerator[0]))


def common_cycles(train: Record, load: Record) -> int:
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
