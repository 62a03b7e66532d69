"""Energy stored in the train, the other side of the ledger."""

from __future__ import annotations

from .._compile import kernel
from .._records import Record
from .body_speed import body_speed
from .mesh_force import stored_energy


@kernel
def stored(model: Record, state: Record, moment: Record) -> tuple[float, float]:
    """Kinetic and elastic energy of the train [J]; `moment` is room to work in."""
    return kinetic(model, state), elastic(model, state, moment)


@kernel
def kinetic(model: Record, state: Record) -> float:
    """Kinetic energy of all bodies, machines included [J]."""
    train = model.train
    total = 0.0
    for j in range(train.bodies):
        speed = body_speed(train, state, state.v, j) * train.radius[j]
        total += 0.5 * train.mass[j] * speed * speed
    return total


@kernel
def elastic(model: Record, state: Record, moment: Record) -> float:
    """Elastic energy of meshes in contact and of the couplings [J]; `moment` is room to work in."""
    train = model.train
    total = 0.0
    for i in range(train.meshes):
        total += stored_energy(model, state, moment, i)
    for c in range(train.machines):
        twist = state.x[train.coupling[c, 0]] - state.x[train.coupling[c, 1]]
        total += 0.5 * train.coupling_stiffness[c] * twist * twist
    return total
