"""Notices meshes in which both flanks of a tooth touch, of which this model carries one.

Runout of which the radial part e_R exceeds half the backlash b presses the other flank into its
neighbour as well, unless the load squeezes the flank that carries by more than 2 (|e_R| - b).
"""

from __future__ import annotations

from .._compile import kernel
from .._records import Record
from ..dynamics.form_errors import radial_error
from ..dynamics.mesh_force import deflection
from ..dynamics.state import OPEN


@kernel
def note_both_flanks(model: Record, march: Record) -> None:
    """Count the step that begins where both flanks of a mesh touch."""
    train, begin, moment = model.train, march.begin, march.moment
    half = model.load.half_backlash
    for i in range(train.meshes):
        kind = train.kind[i]
        if begin.side[i] == OPEN or train.lines[kind] == train.harmonics[kind]:
            continue
        gap = half + radial_error(train, i, moment.line_angle, 0.0, 0.0)[0]
        if gap >= 0.0:
            continue
        d = deflection(train, moment, i, begin.x, begin.v, 0.0, 0.0)[0]
        if begin.side[i] * d - half < -2.0 * gap:
            march.control.both_flanks += 1
            return
