"""Rolling resistance of a film: pushing oil into the contact costs a force on both surfaces.

Goksem and Hargreaves 1978, isothermal line contact: F_R = 4.318 (G U)^0.658 W^0.0126 R L/alpha with
the groups of `film`. It takes F_R (|u1| + |u2|), and grows with the speed where traction no longer
does: the rising end of a Stribeck curve.
"""

from __future__ import annotations

from .._compile import law
from .._vector_math import exp

COEFFICIENT, SPEED, LOAD = 4.318, 0.658, 0.0126


@law
def rolling_resistance(
    size: float, log_speed_group: float, log_material_group: float, log_load_group: float
) -> float:
    """Force F_R [N] on each surface, from R L/alpha [N] and the logarithms of U, G and W."""
    groups = SPEED * (log_speed_group + log_material_group) + LOAD * log_load_group
    return COEFFICIENT * size * exp(groups)
