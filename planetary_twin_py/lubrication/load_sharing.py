"""How film and asperities share the load in mixed lubrication.

mu = X mu_film + (1 - X) mu_boundary, with the film's share X = 0.82 lambda^0.28, at most 1: a fit
in common use for gears (no primary source is at hand). Unlike Greenwood and Tripp's asperities,
which carry a few per cent of a gear's load at lambda = 0, it leads to boundary friction as the film
vanishes.
"""

from __future__ import annotations

from .._compile import law
from .._vector_math import exp

COEFFICIENT, EXPONENT = 0.82, 0.28
THINNEST = 1e-12  # lambda ratio that stands for none at all: a share of 0.04 %


@law
def film_share(log_lambda: float) -> float:
    """Share X of the load that the film carries [-], from the logarithm of the lambda ratio."""
    return min(COEFFICIENT * exp(EXPONENT * log_lambda), 1.0)
