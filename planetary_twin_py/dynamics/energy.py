"""Energy stored in the train, the other side of the ledger."""

from __future__ import annotations

from .._compile import kernel
from .._records import Record
from .contact_events import elastic_energy


@kernel
def kinetic(model: Record, state: Record) -> float:
    """Kinetic energy of all bodies, machines included [J]."""
    train = model.train
    total = 0.0
    for j in range(train.bodies):
        speed = train.ratio[j] * train.radius[j] * state.speed + state.v[j]
        total += 0.5 * train.mass[j] * speed * speed
    return total


@kernel
def elastic(model: Record, state: Record) -> float:
    """Elastic energy of meshes in contact and of the couplings [J]."""
    train = model.train
    total = 0.0
    for i in range(train.meshes):
        total += elastic_energy(model, state, i)
    for c in range(2):
        twist = state.x[train.coupling[c, 0]] - state.x[train.coupling[c, 1]]
        total += 0.5 * train.coupling_stiffness[c] * twist * twist
    return total
