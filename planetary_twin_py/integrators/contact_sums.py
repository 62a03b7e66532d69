"""Integrals over a step of what its tooth pairs show: films and friction, side by side."""

from __future__ import annotations

import numpy as np

from .._compile import kernel, law
from .._records import MESHES, REAL, REGISTER, Record, layout
from .._vector_math import exp
from ..dynamics.equations import share_loads
from ..dynamics.mesh_sums import CLIPPED, CONTACT, FILMED
from ..dynamics.observe import BOUNDARY, FILM, LAMBDA, MESH_POWER, POWER_LOSS, VISCOUS
from ..dynamics.state import ROOM
from ..dynamics.tooth_friction import evaluate, turn_pairs

# Entry p * meshes + i of the first five belongs to pair p of mesh i, as in TOOTH_PAIRS.
CONTACT_SUMS = layout(
    share=(REAL, (ROOM,)),  # of the mesh force [s]
    film=(REAL, (ROOM,)),  # by that share [m s]
    boundary=(REAL, (ROOM,)),  # [N s]
    viscous=(REAL, (ROOM,)),  # [N s]
    lost=(REAL, (ROOM,)),  # [J]
    touching=(REAL, (MESHES,)),  # [s]
    clipped=(REAL, (MESHES,)),  # [s]
    rolled=(REAL, (MESHES,)),  # through the mesh [J]
)


@law
def _width(train: Record) -> int:
    """Pairs in whole registers."""
    return -(-train.slots * train.meshes // REGISTER) * REGISTER


@kernel
def clear_contacts(train: Record, sums: Record) -> None:
    """Let a CONTACT_SUMS begin again."""
    for k in range(_width(train)):
        sums.share[k] = sums.film[k] = 0.0
        sums.boundary[k] = sums.viscous[k] = sums.lost[k] = 0.0
    for i in range(train.lanes):
        sums.touching[i] = sums.clipped[i] = sums.rolled[i] = 0.0


@kernel
def find_contacts(model: Record, moment: Record, v: np.ndarray, work: Record) -> None:
    """Films of a train without friction, under the pushes in `work`, an EVALUATION."""
    share_loads(model, moment, work)
    turn_pairs(model.train, moment, v, work.pairs)
    evaluate(model, work.pairs)


@kernel
def add_films(train: Record, pairs: Record, weight: float, sums: Record) -> None:
    """Add shares and films of all pairs, a TOOTH_PAIRS, times `weight` [s]."""
    for k in range(_width(train)):
        share = weight * pairs.share[k]
        sums.share[k] += share
        sums.film[k] += share * exp(pairs.log_film[k])


@kernel
def add_friction(train: Record, work: Record, weight: float, sums: Record) -> None:
    """Add friction and forces of an EVALUATION, times `weight` [s]."""
    pairs, now, meshes = work.pairs, work.now, train.meshes
    rolling = weight * train.base_pitch * abs(now.pace)
    for i in range(train.lanes):
        push = now.push[i]
        sums.touching[i] += weight if push != 0.0 else 0.0
        sums.rolled[i] += rolling * max(push, 0.0)
    if not train.friction:
        return
    for k in range(_width(train)):
        sums.boundary[k] += weight * pairs.boundary[k]
        sums.viscous[k] += weight * pairs.viscous[k]
        lost = pairs.friction[k] * pairs.sliding[k] + pairs.rolling_power[k]
        sums.lost[k] += weight * lost
    for i in range(meshes):
        viscous = 0.0
        for p in range(train.slots):
            viscous += pairs.viscous[p * meshes + i]
        sums.clipped[i] += weight if now.push[i] > 0.0 and viscous == 0.0 else 0.0


@kernel
def put_contacts(train: Record, oil: Record, sums: Record, out: np.ndarray) -> None:
    """Write the sums of the pairs of each mesh into `out`, the integrals of a MESH_SUMS."""
    given = oil.lambda_ratio if oil.prescribed else 0.0
    per_film = 0.0 if oil.prescribed else exp(-oil.log_roughness)
    for i in range(train.meshes):
        share = film = boundary = viscous = lost = 0.0
        for p in range(train.slots):
            k = p * train.meshes + i
            share += sums.share[k]
            film += sums.film[k]
            boundary += sums.boundary[k]
            viscous += sums.viscous[k]
            lost += sums.lost[k]
        out[FILMED, i], out[FILM, i] = share, film
        out[LAMBDA, i] = given * share + per_film * film
        out[BOUNDARY, i], out[VISCOUS, i], out[POWER_LOSS, i] = boundary, viscous, lost
        out[CONTACT, i], out[MESH_POWER, i] = sums.touching[i], sums.rolled[i]
        out[CLIPPED, i] = sums.clipped[i] if train.friction else sums.touching[i]
