"""Where a run begins: the train in quasi-static equilibrium at its operating point.

Each flank carries what the mean torque puts on it, the couplings are wound up, and the load is
trimmed for the friction of one mesh cycle, so that a run is steady from its first moment but for
the vibration that the meshes start.
"""

from __future__ import annotations

import math

import numpy as np

from .._records import Record, new_record
from ..scene import OperatingPoint, Scene
from .contact_events import find_segment, mesh_cycle, nearest_to_segment
from .equations import EVALUATION, MOMENT, forces, stiffness
from .state import COAST_SIDE, DRIVE_SIDE, FRICTION, LOAD, STATE

CYCLE_POINTS = 64  # positions within the mesh cycle over which friction is averaged
SETTLING_PASSES = 3  # the first winds up the couplings, the others find the tooth pairs there


def build_load(scene: Scene, point: OperatingPoint, train: Record) -> Record:
    """What acts on the train at an operating point."""
    control = scene.drive.speed_control
    motor, brake = train.coupling[0, 0], train.coupling[1, 0]
    inertia = train.mass * train.radius**2  # J of each body
    total = float(np.sum(inertia * train.ratio**2) / train.ratio[motor] ** 2)
    bandwidth = 2.0 * math.pi * control.bandwidth
    return new_record(
        LOAD,
        half_backlash=0.5 * point.backlash,
        lambda_ratio=point.lambda_ratio,
        target_speed=point.input_speed,
        slew_rate=control.slew_rate,
        torque=point.input_torque,
        ripple=point.torque_ripple,
        ripple_order=float(control.ripple_order),
        output_gain=-1.0 / float(train.ratio[brake]),
        inertia=total,
        proportional=total * bandwidth,
        integral=total * bandwidth**2 / 4.0,  # critically damped
    )


def mesh_loads(scene: Scene, train: Record, torque: float) -> np.ndarray:
    """Mean mesh forces (meshes,) [N] that carry an input torque [N m] without loss."""
    teeth, drive = scene.gearset.tooth_numbers, scene.drive
    parts = {"sun": teeth.sun, "ring": teeth.ring, "carrier": -(teeth.sun + teeth.ring)}
    # Sun and ring torques are as their teeth: Ts : Tr : Tc = Zs : Zr : -(Zs + Zr).
    sun_torque = torque * teeth.sun / parts[drive.input.member]
    force = sun_torque / (_sun_base_radius(scene) * scene.gearset.planets)
    return np.full(train.meshes, force)


def _sun_base_radius(scene: Scene) -> float:
    gearset = scene.gearset
    return 0.5 * gearset.module * gearset.teeth.sun * math.cos(gearset.pressure_angle)


def start_state(scene: Scene, model: Record) -> Record:
    """The state in which a run begins, at time zero and motor angle zero."""
    train, load = model.train, model.load
    state = new_record(STATE)
    state.speed = state.set_speed = load.target_speed
    mean = mesh_loads(scene, train, load.torque)
    state.side[: train.meshes] = DRIVE_SIDE if mean[0] >= 0.0 else COAST_SIDE
    moment = new_record(MOMENT)
    moment.cycle_rate = train.cycles * load.target_speed / (2.0 * math.pi)
    loss = 0.0
    evaluation = new_record(EVALUATION)
    for point in range(CYCLE_POINTS):
        state.fraction = point / (CYCLE_POINTS * abs(train.cycles))
        _settle(model, state, moment, mean)
        loss += _friction_power(model, state, moment, evaluation) / CYCLE_POINTS
    state.fraction = 0.0
    _settle(model, state, moment, mean)
    if load.target_speed != 0.0:
        # In steady running the load gives up the torque that friction takes.
        state.trim = loss / load.target_speed / load.integral
    return state


def _friction_power(model: Record, state: Record, moment: Record, evaluation: Record) -> float:
    forces(model, state, moment, state.x, state.v, 0.0, 0.0, evaluation)
    return float(evaluation.power[FRICTION])


def _settle(model: Record, state: Record, moment: Record, mean: np.ndarray) -> None:
    """Choose x so that every mesh and coupling carries its mean load at the present motor angle.

    The couplings wind up by a good part of a mesh cycle, which moves the tooth pairs, whose
    stiffness decides how far the meshes yield.
    """
    for _ in range(SETTLING_PASSES):
        _place_pairs(model.train, state, moment)
        _balance(model, state, moment, mean)
    _place_pairs(model.train, state, moment)


def _place_pairs(train: Record, state: Record, moment: Record) -> None:
    """Let every mesh have the tooth pairs that belong to its place in the cycle."""
    for i in range(train.meshes):
        kind, side = train.kind[i], int(state.side[i])
        cycle = mesh_cycle(train, state, i, side)
        direction = math.copysign(1.0, side * moment.cycle_rate)
        state.segment[i] = find_segment(train, kind, cycle, direction)
        moment.start[i] = nearest_to_segment(train, kind, state.segment[i], cycle)


def _balance(model: Record, state: Record, moment: Record, mean: np.ndarray) -> None:
    """Choose x for the tooth pairs that are in contact.

    Least squares, because more meshes than bodies ask for a place: all of them get theirs only
    if all are equally stiff at this angle.
    """
    train, load = model.train, model.load
    bodies = train.bodies + 1
    rows, targets, weights = [], [], []
    for i in range(train.meshes):
        k = stiffness(train, train.kind[i], state.segment[i], moment.start[i])
        row = np.zeros(bodies)
        np.add.at(row, train.body[i], train.sign[i])
        rows.append(row)
        targets.append(state.side[i] * load.half_backlash + mean[i] / k)
        weights.append(k)
    torques = (load.torque, load.output_gain * load.torque)
    for c, (machine, member) in enumerate(train.coupling):
        row = np.zeros(bodies)
        row[machine], row[member] = 1.0, -1.0
        rows.append(row)
        targets.append(torques[c] / train.radius[machine] / train.coupling_stiffness[c])
        weights.append(train.coupling_stiffness[c])
    motor = np.zeros(bodies)
    motor[train.coupling[0, 0]] = 1.0
    ground = np.zeros(bodies)
    ground[train.bodies] = 1.0
    matrix = np.array([*rows, motor, ground])
    scale = np.sqrt(np.array([*weights, max(weights), max(weights)]))
    right = np.array([*targets, 0.0, 0.0])
    state.x[:bodies] = np.linalg.lstsq(matrix * scale[:, None], right * scale, rcond=None)[0]
    state.x[train.bodies] = 0.0
