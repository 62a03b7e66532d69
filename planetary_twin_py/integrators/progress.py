"""A run in progress, as records that the kernels of this folder write in place."""

from __future__ import annotations

from .._records import AXES, FLAG, REAL, WHOLE, layout
from ..dynamics.equations import EVALUATION
from ..dynamics.moment import MOMENT
from ..dynamics.state import STATE
from .propagation import PROPAGATION
from .repetition import REPETITION
from .rosenbrock import WORKSPACE
from .step_sums import STEP_SUMS

AUTO, COLLOCATION, ROSENBROCK = 0, 1, 2
NO_MESH = -1
SHORTEST_STEP = 1e-13  # [s] below it two events count as one
DETOUR = 20  # steps of Rosenbrock's method before collocation is tried again
SAFETY, SHRINK, GROW = 0.8, 0.25, 2.0  # of steps

# Step control and counters.
CONTROL = layout(
    tolerance=REAL,  # relative to the deflection of the meshes
    deflection=REAL,  # under the torques of steady running [m]
    yielding=(REAL, (AXES,)),  # and under each acceleration of a set-point [m s^2/rad]
    quickness=REAL,  # speed of a body per deflection [1/s]
    tolerance_x=REAL,  # local error this step may make in a transmission error [m]
    tolerance_v=REAL,  # and in the speed of a body [m/s]
    creeping=FLAG,  # tooth pairs hold, see `dynamics.bristles`
    slow=FLAG,  # the layer in which friction reverses limits the errors of speeds
    next_step=REAL,  # [s]
    step=REAL,  # the last one taken [s]
    longest=REAL,  # [s]
    method=WHOLE,  # AUTO, COLLOCATION or ROSENBROCK
    collocated=FLAG,  # how the last step was made
    detour=WHOLE,  # steps still to be made by the other method
    next_stiff=REAL,  # next step of that [s]
    changed=FLAG,  # contacts or loads are no longer those of the last evaluation
    steps=WHOLE,
    repeated=WHOLE,  # steps of steady running that were not made again, see `repetition`
    stiff_steps=WHOLE,  # of them by Rosenbrock's method
    rejected=WHOLE,
    evaluations=WHOLE,
    pair_events=WHOLE,
    flank_events=WHOLE,
    reversals=WHOLE,  # steps in which vibration may reverse friction, see `creep`
    both_flanks=WHOLE,  # steps in which both flanks of a mesh touch, see there
)

# A run in progress: the step from `begin` to `end`, and what interpolates it.
MARCH = layout(
    begin=STATE,
    end=STATE,
    moment=MOMENT,
    aside=MOMENT,  # room for where a mesh stands at an event
    first=EVALUATION,  # forces at `begin`
    last=EVALUATION,  # forces at `end`, with the contacts of `begin`
    dense=STATE,  # x and v within the step
    control=CONTROL,
    work=WORKSPACE,
    run=PROPAGATION,
    repetition=REPETITION,
    sums=STEP_SUMS,  # of what the meshes show, over the last step and those before
)
