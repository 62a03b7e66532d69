"""Statistics of rough surfaces in contact (Greenwood and Tripp 1970).

F_n(lambda) = 1/sqrt(2 pi) * integral from lambda to infinity of (s-lambda)^n exp(-s^2/2) ds.
Both functions are given as exp of a quartic fitted to that integral: relative error below
3e-4 for 0 <= lambda <= 4, positive and falling everywhere up to `LARGEST_LAMBDA`.
"""

from __future__ import annotations

from .._compile import law
from .._vector_math import exp

LARGEST_LAMBDA = 6.0  # asperities carry nothing beyond: F_5/2(6) is 6e-13


@law
def contact_area_function(lambda_ratio: float) -> float:
    """F_2 [-], which scales the area of the asperities in contact."""
    x = min(lambda_ratio, LARGEST_LAMBDA)
    return exp(
        (((0.00130501 * x - 0.0241815) * x - 0.275167) * x - 1.59436) * x - 0.693356
    )


@law
def contact_load_function(lambda_ratio: float) -> float:
    """F_5/2 [-], which scales the load the asperities carry."""
    x = min(lambda_ratio, LARGEST_LAMBDA)
    return exp(
        (((0.00117382 * x - 0.0230728) * x - 0.270566) * x - 1.74266) * x - 0.483601
    )
