"""Where a run begins: the train in quasi-static equilibrium at its operating point.

Each flank carries what the mean torque puts on it, the couplings are wound up, and the torques
are trimmed for the friction of one mesh cycle, so that a run is steady from its first moment but
for the vibration that the meshes start.
"""

from __future__ import annotations

import math

import numpy as np

from .._records import AXES, MACHINES, Record, new_record
from ..scene import OperatingPoint, Scene
from .bodies import LOAD_MACHINE, MOTOR, SECOND_MOTOR
from .cycle import find_segment, mesh_cycle
from .equations import EVALUATION, forces
from .form_errors import form_error
from .mesh_force import deflection, mesh_stiffness
from .moment import MOMENT, frame_cycle_rate, set_moment
from .state import COAST_SIDE, DRIVE_SIDE, LOAD, OPEN, STATE
from .static_load import mesh_force, static_torques

CYCLE_POINTS = 64  # positions within the mesh cycle over which friction is averaged
SETTLING_PASSES = 3  # the first winds up the couplings, the others find the tooth pairs there


def build_load(scene: Scene, point: OperatingPoint, train: Record) -> Record:
    """What acts on the train at an operating point."""
    control, axes = scene.drive.speed_control, int(train.axes)
    torques = static_torques(scene)
    inertia = np.einsum("j,ja,jb->ab", train.mass * train.radius**2, train.ratio, train.ratio)
    bandwidth = 2.0 * math.pi * control.bandwidth
    integral = np.diag(inertia) * bandwidth**2 / 4.0  # critically damped
    trim_gain = np.zeros((MACHINES, AXES))
    # The first motor gives just its torque; the load is trimmed so that its speed holds.
    trim_gain[LOAD_MACHINE, 0] = -torques[LOAD_MACHINE] * integral[0]
    if axes > 1:
        trim_gain[SECOND_MOTOR, 1] = integral[1]
    half, offset = _play(scene, point)
    return new_record(
        LOAD,
        half_backlash=half,
        offset=offset,
        inner_squared=(half - offset) ** 2,
        release=1.0 if scene.mesh.backlash == "dead_zone" else 0.0,
        target_speed=np.array([point.input_speed, point.second_input_speed][:axes]),
        slew_rate=control.slew_rate,
        torque=point.input_torque * torques,
        ripple=point.torque_ripple,
        ripple_order=float(control.ripple_order),
        inertia=inertia,
        proportional=np.diag(inertia) * bandwidth,
        trim_gain=trim_gain,
    )


def _play(scene: Scene, point: OperatingPoint) -> tuple[float, float]:
    """Transmission errors at which flanks meet, and from which the force grows [m]."""
    along = math.cos(scene.gearset.pressure_angle) if scene.mesh.motion == "pitch_arc" else 1.0
    if scene.mesh.backlash == "regulatory_factor":
        return point.backlash * along, 0.0
    half = 0.5 * point.backlash * along
    return half, half


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
    drag = np.zeros(axes)
    for point in range(CYCLE_POINTS):
        state.fraction[0] = point / (CYCLE_POINTS * abs(train.cycles[0]))
        _settle(model, state, moment, mean)
        drag += _drag(model, state, moment) / CYCLE_POINTS
    state.fraction[0] = 0.0
    _settle(model, state, moment, mean)
    _choose_sides(model, state, moment)
    # In steady running the machines give what friction takes along each rigid motion.
    bodies = train.coupling[: train.machines, 0]
    effect = train.ratio[bodies, :axes].T @ load.trim_gain[: train.machines, :axes]
    state.trim[:axes] = np.linalg.solve(effect, drag)
    return state


def _drag(model: Record, state: Record, moment: Record) -> np.ndarray:
    """Torques against the rigid motion of each motor [N m]: friction, all else being balanced."""
    train, evaluation = model.train, new_record(EVALUATION)
    steady = model.copy()
    steady.load.ripple = 0.0
    steady.load.proportional[:] = 0.0
    still = moment.copy()
    still.slew[:] = 0.0
    forces(steady, state, still, state.x, state.v, 0.0, np.zeros(AXES), evaluation)
    torque = evaluation.force * train.radius
    return -(train.ratio.T @ torque)[: int(train.axes)]


def _settle(model: Record, state: Record, moment: Record, mean: float) -> None:
    """Choose x so that every mesh and coupling carries its mean load at the present motor angle.

    The couplings wind up by a good part of a mesh cycle, which moves the tooth pairs, whose
    stiffness decides how far the meshes yield.
    """
    for _ in range(SETTLING_PASSES):
        _place_pairs(model, state, moment)
        _balance(model, state, moment, mean)
    _place_pairs(model, state, moment)


def _place_pairs(model: Record, state: Record, moment: Record) -> None:
    """Let every mesh have the tooth pairs that belong to its place in the cycle."""
    train = model.train
    for i in range(train.meshes):
        side = int(state.side[i])
        if side == OPEN:
            continue
        direction = math.copysign(1.0, side * frame_cycle_rate(train, state))
        cycle = mesh_cycle(train, state, i, side)
        state.segment[i] = find_segment(train, train.kind[i], cycle, direction)
    set_moment(model, state, moment)


def _choose_sides(model: Record, state: Record, moment: Record) -> None:
    """Let every mesh touch where its flanks are: errors of form beyond its deflection part them."""
    train, half = model.train, float(model.load.half_backlash)
    for i in range(train.meshes):
        d = deflection(train, moment, i, state.x, state.v, 0.0, 0.0)[0]
        if state.side[i] * d < half:
            state.side[i] = OPEN if abs(d) <= half else -state.side[i]
    _place_pairs(model, state, moment)


def _balance(model: Record, state: Record, moment: Record, mean: float) -> None:
    """Choose x for the tooth pairs that are in contact.

    Least squares, because more meshes than bodies ask for a place: all of them get theirs only
    if all are equally stiff at this angle.
    """
    train, load = model.train, model.load
    bodies = train.bodies + 1
    rows, targets, weights = [], [], []
    for i in range(train.meshes):
        k = mesh_stiffness(train, train.kind[i], state.segment[i], moment.start[i])
        error = form_error(train, i, moment.line_angle, 0.0, 0.0)[0]
        row = np.zeros(bodies)
        np.add.at(row, train.body[i], train.sign[i])
        rows.append(row)
        targets.append(state.side[i] * load.offset + error + mean / k)
        weights.append(k)
    for c, (machine, member) in enumerate(train.coupling[: train.machines]):
        row = np.zeros(bodies)
        row[machine], row[member] = 1.0, -1.0
        rows.append(row)
        targets.append(load.torque[c] / train.radius[machine] / train.coupling_stiffness[c])
        weights.append(train.coupling_stiffness[c])
    still = [*train.coupling[: 2 * train.axes : 2, 0], train.bodies]  # motors and ground
    rows += list(np.eye(bodies)[still])
    scale = np.sqrt(np.array(weights + [max(weights)] * len(still)))
    right = np.array(targets + [0.0] * len(still))
    matrix = np.array(rows)
    state.x[:bodies] = np.linalg.lstsq(matrix * scale[:, None], right * scale, rcond=None)[0]
    state.x[train.bodies] = 0.0
