"""Friction of all loaded tooth pairs of the train, side by side.

The pairs of all meshes stand in columns, so that the laws of friction run over them in vector
registers; then each is applied as a generalised force Q_j = -f dVs/dw_j, which takes exactly f Vs
out of the motion, whatever turns and whatever is held.
"""

from __future__ import annotations

import numpy as np

from .._compile import kernel, law
from .._overwrite import copy_array
from .._records import FLAG, MESHES, REAL, REGISTER, WHOLE, Record, layout
from ..lubrication.traction import EYRING, PLATEAU
from .bristles import hold
from .creep import CREEPING
from .state import ROOM
from .tooth_contact import SLOWEST_ROLLING, Laws, choices, tooth_contact

# Friction reverses within a layer as wide as at this part of the rolling speed without vibration,
# at least: where vibration stops the gears, the layer would vanish and no step could resolve it.
SLOWEST = 0.1
NARROWEST = 5e-3  # slide-to-roll ratio: friction that reverses within less is passed as a step
SLOWEST_TURN = 1e-3  # [rad/s] below which the printed torque fades out

# Entry p * meshes + i is pair p of mesh i; one that is absent, or parted, has no load.
TOOTH_PAIRS = layout(
    count=WHOLE,
    slowest_rolling=REAL,  # that sets the least width of the layer in which friction reverses [m/s]
    share=(REAL, (ROOM,)),  # of the mesh force [-]
    rho1=(REAL, (ROOM,)),  # radii of curvature [m]
    rho2=(REAL, (ROOM,)),
    external=(REAL, (ROOM,)),  # +1: external mesh, -1: internal
    speed1=(REAL, (ROOM,)),  # of the gears relative to the carrier [rad/s]
    speed2=(REAL, (ROOM,)),
    load=(REAL, (ROOM,)),  # [N]
    friction=(REAL, (ROOM,)),  # signed, against the sliding [N]
    boundary=(REAL, (ROOM,)),  # [N]
    viscous=(REAL, (ROOM,)),  # [N]
    log_film=(REAL, (ROOM,)),  # logarithm of the film thickness in metres
    sliding=(REAL, (ROOM,)),  # [m/s]
    slope=(REAL, (ROOM,)),  # of friction over sliding [N s/m]
    rolling=(REAL, (ROOM,)),  # rolling resistance, signed [N]
    rolling_power=(REAL, (ROOM,)),  # that it takes [W]
    held=FLAG,  # whether bristles join the flanks, see `bristles`; then, of each pair:
    bristle=(REAL, (ROOM,)),  # share of the full friction [-]
    full=(REAL, (ROOM,)),  # that friction [N]
    bristle_rate=(REAL, (ROOM,)),  # of the share [1/s]
    bristle_decay=(REAL, (ROOM,)),  # by which that falls as the share grows [1/s]
    bristle_gain=(REAL, (ROOM,)),  # by which it grows with the sliding [1/m]
    lost=(REAL, (ROOM,)),  # power that is not stored in the bristles [W]
)

# What the friction of a mesh does to its gears and the carrier.
DRAG_OF_MESHES = layout(
    torque=(REAL, (3, MESHES)),  # [N m]
    power=(REAL, (MESHES,)),  # lost [W]
)


@kernel
def turn_pairs(train: Record, moment: Record, v: np.ndarray, pairs: Record) -> None:
    """Speeds of the gears of all pairs."""
    meshes = train.meshes
    rolling = SLOWEST * train.rolling_advance * abs(moment.cycle_rate)
    pairs.slowest_rolling = max(rolling, SLOWEST_ROLLING)
    for i in range(meshes):
        first, second, carrier = train.body[i, 0], train.body[i, 1], train.body[i, 2]
        frame = moment.rigid[carrier] + v[carrier] * train.inverse_radius[carrier]
        speed1 = moment.rigid[first] + v[first] * train.inverse_radius[first] - frame
        speed2 = moment.rigid[second] + v[second] * train.inverse_radius[second] - frame
        for p in range(train.slots):
            pairs.speed1[p * meshes + i] = speed1
            pairs.speed2[p * meshes + i] = speed2


@law
def friction_layer(train: Record, oil: Record, cycle_rate: float) -> float:
    """Sliding speed [m/s] within which friction reverses at the pitch point.

    Both flanks roll there at r sin(alpha) w = tan(alpha) p_b f_m, at either kind of mesh.
    """
    rolling = train.rolling_advance * abs(cycle_rate)
    return max(oil.sliding_threshold, NARROWEST) * max(rolling, CREEPING)


@kernel
def evaluate(model: Record, pairs: Record) -> None:
    """Film and friction of all pairs."""
    laws = choices(model.oil)
    # Constants take the laws not chosen out of the loop, which halves its time.
    if laws == (True, False, False, False, PLATEAU):
        _evaluate(model, (True, False, False, False, PLATEAU), pairs)
    elif laws == (False, False, False, False, PLATEAU):
        _evaluate(model, (False, False, False, False, PLATEAU), pairs)
    elif laws == (False, False, True, False, EYRING):
        _evaluate(model, (False, False, True, False, EYRING), pairs)
    else:
        _evaluate(model, laws, pairs)
    if pairs.held:
        hold(model.oil, pairs)


@law
def _evaluate(model: Record, laws: Laws, pairs: Record) -> None:
    """Whole registers of pairs, so that lanes beyond `count` are idle."""
    slowest = pairs.slowest_rolling
    for p in range(-(-pairs.count // REGISTER) * REGISTER):
        signed, boundary, viscous, log_film, sliding, slope, rolling, taken = tooth_contact(
            model.oil,
            laws,
            (
                pairs.rho1[p],
                pairs.rho2[p],
                pairs.external[p],
                pairs.speed1[p],
                pairs.speed2[p],
                pairs.load[p],
            ),
            slowest,
        )
        pairs.friction[p] = signed
        pairs.boundary[p] = boundary
        pairs.viscous[p] = viscous
        pairs.log_film[p] = log_film
        pairs.sliding[p] = sliding
        pairs.slope[p] = slope
        pairs.rolling[p] = rolling
        pairs.rolling_power[p] = taken


@kernel
def collect(train: Record, pairs: Record, out: Record) -> None:
    """Add up what the pairs of each mesh do: -f dVs/dw and -F_R d(u1 + u2)/dw of both gears."""
    for i in range(train.meshes):
        out.torque[0, i] = out.torque[1, i] = out.power[i] = 0.0
    for p in range(train.slots):
        first = p * train.meshes
        for i in range(train.meshes):
            k = first + i
            f, rolling = pairs.friction[k], pairs.rolling[k]
            out.torque[0, i] -= (f + rolling) * pairs.rho1[k]
            out.torque[1, i] -= (f - rolling) * pairs.external[k] * pairs.rho2[k]
            out.power[i] += f * pairs.sliding[k] + pairs.rolling_power[k]
    for i in range(train.meshes):
        out.torque[2, i] = -(out.torque[0, i] + out.torque[1, i])


@kernel
def collect_printed(
    train: Record, moment: Record, v: np.ndarray, pairs: Record, out: Record
) -> None:
    """Friction torque as Salagianni et al. 2017 print it.

    T = P/w (17) on both gears, with the sign of (18)-(20): it drives every gear the way it turns,
    and so puts in twice what is lost. Divided by (w^2 + w0^2)/w, as 0/0 would stand at rest.
    """
    collect(train, pairs, out)
    for i in range(train.meshes):
        lost, power = out.power[i], 0.0
        for gear in range(2):
            body = train.body[i, gear]
            speed = moment.rigid[body] + v[body] * train.inverse_radius[body]
            torque = lost * speed / (speed * speed + SLOWEST_TURN * SLOWEST_TURN)
            out.torque[gear, i] = torque
            power -= torque * speed
        out.torque[2, i], out.power[i] = 0.0, power


@law
def sliding_row(train: Record, pairs: Record, k: int, row: np.ndarray) -> None:
    """Fill dVs/dv (3,) of pair k for the coordinates of its gears and the carrier."""
    i = k % train.meshes
    rho1, rho2 = pairs.rho1[k], pairs.external[k] * pairs.rho2[k]
    row[0] = rho1 * train.lever[0, i]
    row[1] = rho2 * train.lever[1, i]
    row[2] = -(rho1 + rho2) * train.lever[2, i]


@kernel
def friction_damping(
    train: Record, pairs: Record, force: np.ndarray, h: float, row: np.ndarray, matrix: np.ndarray
) -> None:
    """Add to `matrix` what friction adds to the damping matrix: slope dVs/dv dVs/dv^T.

    Large where little slides: at the pitch point, and for everything near standstill. Where the
    forces on the bodies would turn the sliding round within h seconds, the slope is that of the
    chord to rest: beside it the tangent is flat, and steps would throw the sliding to and fro.
    `row` (3,) is room to work in.
    """
    for k in range(pairs.count):
        i = k % train.meshes
        sliding_row(train, pairs, k, row)
        sliding, slope, gain = pairs.sliding[k], pairs.slope[k], 0.0
        for j in range(3):
            body = train.body[i, j]
            gain += h * row[j] * force[body] / train.mass[body]
        if sliding * (sliding + gain) < 0.0:
            slope = max(slope, pairs.friction[k] / sliding)
        add_outer(matrix, train.body[i], row, train.copies[i] * slope)


@kernel
def add_outer(matrix: np.ndarray, body: np.ndarray, row: np.ndarray, factor: float) -> None:
    """matrix[body, body] += factor * row row^T."""
    for a in range(body.size):
        for b in range(body.size):
            matrix[body[a], body[b]] += factor * row[a] * row[b]


@kernel
def copy_friction(source: Record, target: Record) -> None:
    """Copy what `friction_damping` reads."""
    target.count = source.count
    for k in range(source.count):
        target.rho1[k] = source.rho1[k]
        target.rho2[k] = source.rho2[k]
        target.external[k] = source.external[k]
        target.friction[k] = source.friction[k]
        target.sliding[k] = source.sliding[k]
        target.slope[k] = source.slope[k]
    if source.held:
        copy_array(target.bristle, source.bristle)
        copy_array(target.full, source.full)
        copy_array(target.bristle_rate, source.bristle_rate)
        copy_array(target.bristle_decay, source.bristle_decay)
        copy_array(target.bristle_gain, source.bristle_gain)
