"""When flanks meet and part, and when tooth pairs enter and leave a mesh.

A mesh is on its drive side, on its coast side, or open. Its force must push: in contact it ends
where the force falls below zero, which damping makes happen while the flanks are still squeezed;
open, contact begins where both squeeze and force are positive, with a jump of the force by its
damping. (Al-shyyab and Kahraman 2007 for the dead zone; the flanks never pull.)
"""

from __future__ import annotations

import numpy as np

from .._compile import kernel, law
from .._records import Record
from .bristles import clear_bristles, pass_bristles
from .cycle import cycle_shift, find_segment, frame_cycle, mesh_cycle
from .form_errors import radial_error
from .mesh_force import deflection, stored_energy
from .moment import damping_time, passing_rate, place_mesh
from .state import COAST_SIDE, DAMPING, DRIVE_SIDE, OPEN, STIFFNESS_WORK


@kernel
def departure(
    model: Record,
    state: Record,
    moment: Record,
    i: int,
    x: np.ndarray,
    v: np.ndarray,
    stand: tuple[float, float, float],
) -> float:
    """Play [m] that mesh i has left before its contact changes; negative: it has changed.

    Contact ends where d - b + tau d', which is F/k, falls below zero, and begins where that and
    d - b are positive, on whichever side. Both by a slack: without load, flanks rest against each
    other with no force, and would part and meet without end. (With a regulatory factor the force
    does not count.) Radial errors of form widen the play of an open mesh on both sides.

    Args:
        model, state, moment: the train, and the start of the step.
        i: the mesh.
        x, v: where its bodies are.
        stand: mesh cycles since the start of the step, their pace [1/s], slack [m].
    """
    advance, pace, slack = stand
    d, rate, _ = deflection(model.train, moment, i, x, v, advance, pace)
    tau = damping_time(model.train, model.train.kind[i], passing_rate(model.train, moment, v))
    wider = widening(model.train, moment, i, state.side[i], advance, pace)
    return play_left(model.load, state.side[i], (d, tau * rate), (wider[0], tau * wider[1]), slack)


@law
def widening(
    train: Record, moment: Record, i: int, side: int, advance: float, pace: float
) -> tuple[float, float]:
    """By how far [m] errors of form widen the play of an open mesh on each side, and its rate.

    `deflection` counts the errors of the flanks of a closed mesh already.
    """
    if side != OPEN or train.lines[train.kind[i]] == 0:
        return 0.0, 0.0
    return radial_error(train, i, moment.line_angle, advance, pace)


@law
def play_left(
    load: Record, side: int, motion: tuple[float, float], wider: tuple[float, float], slack: float
) -> float:
    """The same for a mesh on `side`, from its deflection and what widens its play [m].

    `motion` and `wider` are each a length [m], and tau times its rate [m].
    """
    d, half = motion[0], load.half_backlash
    push = d + load.release * motion[1]
    if side != OPEN:
        return side * push - half + slack
    gap, slower = wider[0], wider[0] + load.release * wider[1]
    return slack - max(min(d - gap, push - slower), min(-d - gap, -push - slower)) + half


@kernel
def change_contact(model: Record, state: Record, moment: Record, i: int) -> None:
    """Close an open mesh on the side it has reached, or open a closed one.

    What the flanks still store at the moment they part is lost in the material: flanks part at
    d > b, and later meet again at no compression. `moment` is room for where the mesh stands.
    """
    train = model.train
    before = stored_energy(model, state, moment, i)
    if state.side[i] == OPEN:
        place_mesh(
            train, state, moment, i, frame_cycle(train, state, 1) + cycle_shift(train, state.x)
        )
        d = deflection(train, moment, i, state.x, state.v, 0.0, 0.0)[0]
        side = DRIVE_SIDE if d > 0.0 else COAST_SIDE
        state.segment[i] = find_segment(
            train, train.kind[i], mesh_cycle(train, state, i, side), 1.0
        )
        state.side[i] = side
    else:
        state.side[i] = OPEN
    clear_bristles(train, state.bristle, i)
    state.energy[DAMPING] += before - stored_energy(model, state, moment, i)


@kernel
def change_segment(model: Record, state: Record, moment: Record, i: int, direction: int) -> None:
    """Move mesh i to the next segment; a jump of the stiffness does work on the train."""
    count = model.train.segments[model.train.kind[i]]
    before = stored_energy(model, state, moment, i)
    pass_bristles(model.train, state.bristle, i, state.segment[i], direction)
    state.segment[i] = (state.segment[i] + direction) % count
    state.energy[STIFFNESS_WORK] += stored_energy(model, state, moment, i) - before
