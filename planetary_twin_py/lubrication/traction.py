"""Viscous friction of a thermal elastohydrodynamic film (Evans and Johnson 1986).

Salagianni et al. 2017, eqs. (12), (13). The root of (12) needs a temperature coefficient of
viscosity beta_T [1/K] to be dimensionless; `log_root` carries it. The
printed form is the same with beta_T = 1/K, and falls below zero under a light load.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from .._compile import law
from .._vector_math import exp, log

# Which law gives viscous friction: this plateau, `shear_thinning`, or `schlenk`.
PLATEAU, EYRING, SCHLENK = range(3)


class Traction(NamedTuple):
    """Constants of the traction plateau."""

    shear_stress: float  # [Pa] tau0, Eyring stress
    pressure_viscosity: float  # [1/Pa] alpha
    log_root: float  # logarithm of (1.2/tau0)^2 2 K eta0/beta_T in m^2
    least: float  # [N] friction is never below: 0, or minus infinity for the printed form
    log_heating: float  # logarithm of 9.6 * 4/pi K/sqrt(E' K' rho' c') of (13) in (m s/Pa)^0.5


@law
def viscous_friction(
    traction: Traction, load: float, area: float, log_film: float, log_heat: float
) -> float:
    """Friction f_v [N] on the traction plateau, not below `traction.least`.

    Args:
        load: normal load on the tooth pair [N].
        area: apparent contact area A = 2 b L [m^2]; the mean pressure is load/area.
        log_film: logarithm of the film thickness in metres.
        log_heat: logarithm of sqrt(R p/V) in (Pa s)^0.5, R being the reduced radius of curvature,
            p the mean pressure and V the mean surface speed.
    """
    # 1 + 9.6 zeta, with R/h sqrt(p/(R V)) of (13) written so that one root is enough.
    heating = 1.0 + exp(traction.log_heating + log_heat - log_film)
    log_argument = traction.log_root - 2.0 * log_film - log(heating)
    # 1.74 tau0/p * load is 1.74 tau0 * area: no division by a pressure that may vanish.
    friction = traction.shear_stress * (
        0.87 * traction.pressure_viscosity * load + 0.87 * area * log_argument
    )
    return max(friction, traction.least)


@law
def sliding_sense(ratio: float) -> float:
    """Share of the plateau at a small slide-to-roll ratio, odd in it, within [-1, 1].

    A tanh in the ratio over its threshold: the plateau of (12) has no sliding speed in it, which
    would make friction jump at the pitch point.
    """
    decay = exp(-2.0 * abs(ratio))
    return math.copysign((1.0 - decay) / (1.0 + decay), ratio)
