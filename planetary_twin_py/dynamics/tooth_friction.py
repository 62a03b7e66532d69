"""Friction of all loaded tooth pairs of the train, side by side.

The pairs of all meshes are gathered into columns first, so that the laws of friction run over
them in vector registers; then each is applied as a generalised force Q_j = -f dVs/dw_j, which
takes exactly f Vs out of the motion, whatever turns and whatever is held.
"""

from __future__ import annotations

import numpy as np

from .._compile import kernel, law
from .._records import FLAG, MESHES, REAL, WHOLE, Record, layout
from ..mesh.tooth_pairs import PAIRS
from .body_speed import body_speed
from .tooth_contact import choices, tooth_contact

SLOWEST_TURN = 1e-3  # [rad/s] below which the printed torque fades out
REGISTER = 8  # doubles the compiler works on at a time
INSTANTS = 3
LANES = -(-INSTANTS * MESHES * PAIRS // REGISTER) * REGISTER  # room for all tooth pairs

TOOTH_PAIRS = layout(
    count=WHOLE,  # how many there are
    advance=REAL,  # mesh cycles since the start of the step
    pace=REAL,  # mesh cycles per second
    tau=(REAL, (2,)),  # damping time of each kind of mesh [s]
    wanted=FLAG,  # whether the columns below are to be filled
    mesh=(WHOLE, (LANES,)),
    share=(REAL, (LANES,)),  # of the mesh force [-]
    growth=(REAL, (LANES,)),  # of the weight behind it, per mesh cycle [-]
    rho1=(REAL, (LANES,)),  # radii of curvature [m]
    rho2=(REAL, (LANES,)),
    external=(REAL, (LANES,)),  # +1: external mesh, -1: internal
    speed1=(REAL, (LANES,)),  # of the gears relative to the carrier [rad/s]
    speed2=(REAL, (LANES,)),
    load=(REAL, (LANES,)),  # [N]
    friction=(REAL, (LANES,)),  # signed, against the sliding [N]
    boundary=(REAL, (LANES,)),  # [N]
    viscous=(REAL, (LANES,)),  # [N]
    film=(REAL, (LANES,)),  # [m]
    lambda_ratio=(REAL, (LANES,)),  # [-]
    sliding=(REAL, (LANES,)),  # [m/s]
    slope=(REAL, (LANES,)),  # of friction over sliding [N s/m]
    rolling=(REAL, (LANES,)),  # rolling resistance, signed [N]
)


@kernel
def evaluate(model: Record, pairs: Record) -> None:
    """Film and friction of all pairs."""
    laws = choices(model.oil)
    if not (laws[1] or laws[2] or laws[3]):
        # Constants take the laws not chosen out of the loop, which saves a quarter of its time.
        _evaluate(model, (laws[0], False, False, False), pairs)
    else:
        _evaluate(model, laws, pairs)


@law
def _evaluate(model: Record, laws: tuple[bool, bool, bool, bool], pairs: Record) -> None:
    """Whole registers of pairs, so that lanes beyond `count` are idle."""
    for p in range(-(-pairs.count // REGISTER) * REGISTER):
        signed, boundary, viscous, film, ratio, sliding, slope, rolling = tooth_contact(
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
            model.load.lambda_ratio,
        )
        pairs.friction[p] = signed
        pairs.boundary[p] = boundary
        pairs.viscous[p] = viscous
        pairs.film[p] = film
        pairs.lambda_ratio[p] = ratio
        pairs.sliding[p] = sliding
        pairs.slope[p] = slope
        pairs.rolling[p] = rolling


@kernel
def apply_friction(train: Record, pairs: Record, span: tuple[int, int], force: np.ndarray) -> float:
    """Add the generalised forces -f dVs/dw/r of the pairs in `span`; return their power [W]."""
    power = 0.0
    for p in range(span[0], span[1]):
        i = pairs.mesh[p]
        first, second, carrier = train.body[i, 0], train.body[i, 1], train.body[i, 2]
        f, rho1, rho2 = pairs.friction[p], pairs.rho1[p], pairs.external[p] * pairs.rho2[p]
        force[first] -= f * rho1 / train.radius[first]
        force[second] -= f * rho2 / train.radius[second]
        force[carrier] += f * (rho1 + rho2) / train.radius[carrier]
        power += f * pairs.sliding[p]
    return power


@law
def rolling_power(pairs: Record, p: int) -> float:
    """Power that rolling resistance takes from a tooth pair, F_R (u1 + u2) [W]."""
    u1, u2 = pairs.rho1[p] * pairs.speed1[p], pairs.external[p] * pairs.rho2[p] * pairs.speed2[p]
    return pairs.rolling[p] * (u1 - u2)


@kernel
def apply_rolling(train: Record, pairs: Record, span: tuple[int, int], force: np.ndarray) -> float:
    """Add the generalised forces -F_R d(u1 + u2)/dw/r of pairs in `span`; return the power [W]."""
    power = 0.0
    for p in range(span[0], span[1]):
        i = pairs.mesh[p]
        f, rho1, rho2 = pairs.rolling[p], pairs.rho1[p], -pairs.external[p] * pairs.rho2[p]
        force[train.body[i, 0]] -= f * rho1 / train.radius[train.body[i, 0]]
        force[train.body[i, 1]] -= f * rho2 / train.radius[train.body[i, 1]]
        force[train.body[i, 2]] += f * (rho1 + rho2) / train.radius[train.body[i, 2]]
        power += rolling_power(pairs, p)
    return power


@kernel
def apply_printed_friction(
    train: Record,
    state: Record,
    v: np.ndarray,
    pairs: Record,
    span: tuple[int, int],
    force: np.ndarray,
) -> float:
    """Friction torque as Salagianni et al. 2017 print it; return the power it takes [W].

    T = P/w (17) on both gears, with the sign of (18)-(20): it drives every gear the way it turns,
    and so puts in twice what is lost. Divided by (w^2 + w0^2)/w, as 0/0 would stand at rest.
    """
    power = 0.0
    for p in range(span[0], span[1]):
        lost = pairs.friction[p] * pairs.sliding[p]
        for gear in range(2):
            body = train.body[pairs.mesh[p], gear]
            speed = body_speed(train, state, v, body)
            torque = lost * speed / (speed * speed + SLOWEST_TURN * SLOWEST_TURN)
            force[body] += torque / train.radius[body]
            power -= torque * speed
    return power


@kernel
def friction_damping(train: Record, pairs: Record, matrix: np.ndarray) -> None:
    """Add to `matrix` what friction adds to the damping matrix: slope dVs/dv dVs/dv^T.

    Large where little slides: at the pitch point, and for everything near standstill.
    """
    row = np.empty(3)
    for p in range(pairs.count):
        i = pairs.mesh[p]
        rho1, rho2 = pairs.rho1[p], pairs.external[p] * pairs.rho2[p]
        row[0] = rho1 / train.radius[train.body[i, 0]]
        row[1] = rho2 / train.radius[train.body[i, 1]]
        row[2] = -(rho1 + rho2) / train.radius[train.body[i, 2]]
        add_outer(matrix, train.body[i], row, pairs.slope[p])


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
    for p in range(source.count):
        target.mesh[p] = source.mesh[p]
        target.rho1[p] = source.rho1[p]
        target.rho2[p] = source.rho2[p]
        target.external[p] = source.external[p]
        target.slope[p] = source.slope[p]
