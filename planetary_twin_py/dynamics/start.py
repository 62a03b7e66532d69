"""Where a run begins: the train in quasi-static equilibrium at its operating point.

Each flank carries what the mean torque puts on it, the couplings are wound up, and the torques
are trimmed for the friction of one mesh cycle, so that a run is steady from its first moment but
for the vibration that the meshes start.
"""

from __future__ import annotations

import math

import numpy as np

from .._cholesky import factorise, solve
from .._compile import kernel
from .._overwrite import copy_array
from .._records import AXES, BODIES, REAL, Record, layout, new_record
from ..scene import OperatingPoint, Scene
from .bodies import MOTOR
from .bristles import creeps
from .cycle import find_segment, mesh_cycle
from .equations import EVALUATION, forces
from .form_errors import form_error
from .mesh_force import deflection, mesh_motion, mesh_stiffness
from .moment import MOMENT, frame_cycle_rate, set_moment
from .speed_loop import bandwidth, speed_loop_gains
from .state import COAST_SIDE, DRIVE_SIDE, LOAD, OPEN, STATE
from .static_load import mesh_force, static_torques
from .tooth_friction import add_outer

ENDS = np.array([1.0, -1.0])  # of a coupling
CYCLE_POINTS = 64  # positions within the mesh cycle over which friction is averaged
BALANCING_PASSES = 12  # each leaves some per cent of what friction was off by
SETTLING_PASSES = 3  # the first winds up the couplings, the others find the tooth pairs there


def build_load(scene: Scene, point: OperatingPoint, train: Record) -> Record:
    """What acts on the train at an operating point."""
    control, axes = scene.drive.speed_control, int(train.axes)
    gains = speed_loop_gains(scene, train, bandwidth(scene))
    half, offset = scene.mesh.flanks(point.backlash, scene.gearset.pressure_angle)
    return new_record(
        LOAD,
        half_backlash=half,
        offset=offset,
        inner_squared=(half - offset) ** 2,
        release=1.0 if scene.mesh.backlash == "dead_zone" else 0.0,
        target_speed=np.array([point.input_speed, point.second_input_speed][:axes]),
        slew_rate=control.slew_rate,
        torque=point.input_torque * static_torques(scene),
        ripple=point.torque_ripple,
        ripple_order=float(control.ripple_order),
        inertia=gains.inertia,
        proportional=gains.proportional,
        trim_gain=gains.trim,
    )


BALANCE = layout(
    stiffness=(REAL, (BODIES, BODIES)),
    force=(REAL, (BODIES,)),
    evaluation=EVALUATION,
)


def start_state(scene: Scene, model: Record) -> Record:
    """The state in which a run begins, at time zero and motor angle zero."""
    train, load, axes = model.train, model.load, int(model.train.axes)
    state, moment = new_record(STATE), new_record(MOMENT)
    state.speed[:] = load.target_speed
    if scene.drive.speed_control.start_speed is not None:
        state.speed[0] = scene.drive.speed_control.start_speed
    state.set_speed[:] = state.speed
    mean = mesh_force(scene, float(load.torque[MOTOR]))
    state.side[: train.meshes] = DRIVE_SIDE if mean >= 0.0 else COAST_SIDE
    steady = model.copy()
    steady.load.ripple = 0.0
    steady.load.proportional[:] = 0.0
    room, drag = new_record(BALANCE), np.zeros(AXES)
    _equilibrium(model, steady, state, moment, mean, room, drag)
    # In steady running the machines give what friction takes along each rigid motion.
    bodies = train.coupling[: train.machines, 0]
    effect = train.ratio[bodies, :axes].T @ load.trim_gain[: train.machines, :axes]
    state.trim[:axes] = np.linalg.solve(effect, drag[:axes])
    loaded = bool((state.side[: train.meshes] != OPEN).all())
    if loaded and creeps(train, frame_cycle_rate(train, state)):
        for _ in range(BALANCING_PASSES):
            _balance_friction(steady, state, moment, room, drag)
            state.trim[:axes] += np.linalg.solve(effect, drag[:axes])
    return state


@kernel
def _equilibrium(
    model: Record,
    steady: Record,
    state: Record,
    moment: Record,
    mean: float,
    room: Record,
    drag: np.ndarray,
) -> None:
    """Put `state` into balance; fill the mean drag (AXES,) of the `steady` model."""
    _mean_drag(steady, state, moment, mean, room, drag)
    _settle(model, state, moment, mean, room)
    _choose_sides(model, state, moment)


@kernel
def _mean_drag(
    model: Record, state: Record, moment: Record, mean: float, room: Record, drag: np.ndarray
) -> None:
    """Torques against the rigid motion of each motor [N m]: friction, all else being balanced.

    Means over a mesh cycle from motor angle zero, where `state` is left.
    """
    train = model.train
    work = room.evaluation
    for point in range(CYCLE_POINTS):
        state.fraction[0] = point / (CYCLE_POINTS * abs(train.cycles[0]))
        _settle(model, state, moment, mean, room)
        moment.slew[:] = 0.0
        forces(model, state, moment, state.x, state.v, 0.0, state.trim, work)
        for a in range(train.axes):
            for j in range(train.bodies):
                torque = work.force[j] * train.radius[j]
                drag[a] -= train.ratio[j, a] * torque / CYCLE_POINTS
    state.fraction[0] = 0.0


@kernel
def _settle(model: Record, state: Record, moment: Record, mean: float, room: Record) -> None:
    """Choose x so that every mesh and coupling carries its mean load at the present motor angle.

    The couplings wind up by a good part of a mesh cycle, which moves the tooth pairs, whose
    stiffness decides how far the meshes yield.
    """
    for _ in range(SETTLING_PASSES):
        _place_pairs(model, state, moment)
        _balance(model, state, moment, mean, room)
    _place_pairs(model, state, moment)


@kernel
def _place_pairs(model: Record, state: Record, moment: Record) -> None:
    """Let every mesh have the tooth pairs that belong to its place in the cycle."""
    train = model.train
    for i in range(train.meshes):
        side = state.side[i]
        if side == OPEN:
            continue
        direction = math.copysign(1.0, side * frame_cycle_rate(train, state))
        cycle = mesh_cycle(train, state, i, side)
        state.segment[i] = find_segment(train, train.kind[i], cycle, direction)
    set_moment(model, state, moment)


@kernel
def _choose_sides(model: Record, state: Record, moment: Record) -> None:
    """Let every mesh touch where its flanks are: errors of form beyond its deflection part them."""
    train, half = model.train, model.load.half_backlash
    for i in range(train.meshes):
        side, d = state.side[i], mesh_motion(train, i, state.x)
        own = form_error(train, i, float(side), moment.line_angle, 0.0, 0.0)[0]
        if side * (d - own) < half:
            other = form_error(train, i, float(-side), moment.line_angle, 0.0, 0.0)[0]
            state.side[i] = OPEN if side * (other - d) <= half else -side
    _place_pairs(model, state, moment)


@kernel
def _balance(model: Record, state: Record, moment: Record, mean: float, room: Record) -> None:
    """Move x to where the forces on every body balance, the tooth pairs being those in contact.

    The motors stand still. More meshes than bodies are to carry the mean force: all of them do
    only if all are equally stiff at this angle.
    """
    train, load, force = model.train, model.load, room.force
    force[:] = 0.0
    for i in range(train.meshes):
        k = mesh_stiffness(train, train.kind[i], state.segment[i], moment.start[i])
        d = deflection(train, moment, i, state.x, state.v, 0.0, 0.0)[0]
        push, copies = mean + k * (state.side[i] * load.offset - d), train.copies[i]
        for a in range(3):
            force[train.body[i, a]] += copies * train.sign[i, a] * push
    for c in range(train.machines):
        machine, member = train.coupling[c, 0], train.coupling[c, 1]
        pull = load.torque[c] / train.radius[machine]
        pull -= train.coupling_stiffness[c] * (state.x[machine] - state.x[member])
        force[machine] += pull
        force[member] -= pull
    _yield_to(train, state, moment, room)


@kernel
def _balance_friction(
    model: Record, state: Record, moment: Record, room: Record, drag: np.ndarray
) -> None:
    """Move x to where all forces balance, those of friction too, as where the gears creep.

    The motors stand still. Fills the torques that are missing along the motion of each (AXES,).
    """
    train, work = model.train, room.evaluation
    moment.slew[:] = 0.0
    forces(model, state, moment, state.x, state.v, 0.0, state.trim, work)
    copy_array(room.force, work.force)
    _yield_to(train, state, moment, room)
    _place_pairs(model, state, moment)
    moment.slew[:] = 0.0
    forces(model, state, moment, state.x, state.v, 0.0, state.trim, work)
    for a in range(train.axes):
        drag[a] = 0.0
        for j in range(train.bodies):
            drag[a] -= train.ratio[j, a] * work.force[j] * train.radius[j]


@kernel
def _yield_to(train: Record, state: Record, moment: Record, room: Record) -> None:
    """Move x by what springs of meshes and couplings yield to `room.force`, the motors held."""
    stiffness, force = room.stiffness, room.force
    stiffness[:] = 0.0
    for i in range(train.meshes):
        k = mesh_stiffness(train, train.kind[i], state.segment[i], moment.start[i])
        add_outer(stiffness, train.body[i], train.sign[i], train.copies[i] * k)
    for c in range(train.machines):
        add_outer(stiffness, train.coupling[c], ENDS, train.coupling_stiffness[c])
    for a in range(train.axes):
        _hold(stiffness, force, train.coupling[2 * a, 0])
    factorise(stiffness, train.bodies)
    solve(stiffness, train.bodies, force)
    for j in range(train.bodies):
        state.x[j] += force[j]


@kernel
def _hold(stiffness: np.ndarray, force: np.ndarray, body: int) -> None:
    """Let a body stay where it is."""
    stiffness[body] = 0.0
    stiffness[:, body] = 0.0
    stiffness[body, body] = 1.0
    force[body] = 0.0
