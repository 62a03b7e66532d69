"""State of a running train, and what acts on it from outside."""

from __future__ import annotations

from .._records import BODIES, MESHES, REAL, WHOLE, layout

DRIVE_SIDE, OPEN, COAST_SIDE = 1, 0, -1

# Entries of `energy`, integrals since the start [J], and of the powers they grow by [W].
INPUT, OUTPUT, FRICTION, DAMPING, STIFFNESS_WORK = range(5)
LEDGER = 5

# Everything that changes. The frame in which x is measured stands at `turns` + `fraction` turns
# of the motor and turns with `speed`; the motor's own x and v are zero whenever a step begins.
STATE = layout(
    x=(REAL, (BODIES,)),  # [m]
    v=(REAL, (BODIES,)),  # [m/s]
    side=(WHOLE, (MESHES,)),  # DRIVE_SIDE, OPEN or COAST_SIDE
    segment=(WHOLE, (MESHES,)),  # of the table of tooth pairs
    time=REAL,  # [s]
    turns=REAL,  # whole turns of the motor
    fraction=REAL,  # of a turn, in [0, 1)
    speed=REAL,  # of the motor [rad/s]
    trim=REAL,  # integral of the speed error [rad]
    set_speed=REAL,  # slewed set-point [rad/s]
    energy=(REAL, (LEDGER,)),  # [J]
)

# What acts on the train: the operating point and the constants of the drive.
LOAD = layout(
    half_backlash=REAL,  # [m]
    lambda_ratio=REAL,  # [-]
    target_speed=REAL,  # [rad/s]
    slew_rate=REAL,  # [rad/s^2]
    torque=REAL,  # mean torque of the motor [N m]
    ripple=REAL,  # its fluctuation [N m]
    ripple_order=REAL,  # cycles per turn of the motor
    output_gain=REAL,  # torque of the load per torque of the motor, rigid and without loss [-]
    inertia=REAL,  # of the whole train at the motor [kg m^2]
    proportional=REAL,  # speed loop, at the motor [N m s/rad]
    integral=REAL,  # speed loop, at the load, referred to the motor [N m/rad]
)
