"""State of a running train, and what acts on it from outside."""

from __future__ import annotations

from .._records import AXES, BODIES, MACHINES, MESHES, REAL, WHOLE, layout
from ..mesh.tooth_pairs import PAIRS

DRIVE_SIDE, OPEN, COAST_SIDE = 1, 0, -1
ROOM = (PAIRS + 1) * MESHES  # for all tooth pairs, and what whole registers write beyond

# Entries of `energy`, integrals since the start, and of the powers they grow by: work [J] and
# angular impulse [N m s] that each machine has put in, then what tooth friction, damping, bearings
# and churning have taken and what the meshes have put in by changing their shape [J].
WORK, IMPULSE = 0, MACHINES
FRICTION, DAMPING, BEARING, CHURNING, STIFFNESS_WORK = range(2 * MACHINES, 2 * MACHINES + 5)
LEDGER = 2 * MACHINES + 5

# Everything that changes. The frame in which x is measured stands at `turns` + `fraction` turns
# of the motors and turns with `speed`; the motors' own x and v are zero whenever a step begins.
STATE = layout(
    x=(REAL, (BODIES,)),  # [m]
    v=(REAL, (BODIES,)),  # [m/s]
    side=(WHOLE, (MESHES,)),  # DRIVE_SIDE, OPEN or COAST_SIDE
    segment=(WHOLE, (MESHES,)),  # of the table of tooth pairs
    seconds=WHOLE,  # whole ones since the start
    time=REAL,  # since then [s]
    turns=(REAL, (AXES,)),  # whole turns of each motor
    fraction=(REAL, (AXES,)),  # of a turn, in [0, 1)
    speed=(REAL, (AXES,)),  # of each motor [rad/s]
    trim=(REAL, (AXES,)),  # integral of the speed error [rad]
    set_speed=(REAL, (AXES,)),  # slewed set-point [rad/s]
    energy=(REAL, (LEDGER,)),  # [J], [N m s]
    bristle=(REAL, (ROOM,)),  # of the tooth pairs, while they hold: share of full friction [-]
)

# What acts on the train: the operating point and the constants of the drive.
LOAD = layout(
    half_backlash=REAL,  # where flanks meet [m]
    offset=REAL,  # transmission error from which the force grows [m]
    inner_squared=REAL,  # squeeze at which flanks meet, squared [m^2]
    release=REAL,  # 1: flanks part where the force vanishes, 0: where they met
    target_speed=(REAL, (AXES,)),  # [rad/s]
    slew_rate=REAL,  # [rad/s^2]
    torque=(REAL, (MACHINES,)),  # mean torque of each machine without loss [N m]
    ripple=REAL,  # fluctuation of the first motor's [N m]
    ripple_order=REAL,  # cycles per turn of that motor
    inertia=(REAL, (AXES, AXES)),  # of the whole train at the motors [kg m^2]
    proportional=(REAL, (AXES,)),  # speed loop, at the motor [N m s/rad]
    trim_gain=(REAL, (MACHINES, AXES)),  # speed loop, torque per trim [N m/rad]
)
