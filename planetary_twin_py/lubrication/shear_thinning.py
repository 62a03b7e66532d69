"""Viscous friction of a film that thins under shear, up to its limiting stress.

The law of Ree and Eyring with a limiting stress (Johnson and Tevaarwerk 1977; Arana, Larranaga and
Ulacia 2019, eq. (7)), tau = min(tau0 asinh(eta Vs/(h tau0)), Lambda p), holds from the Newtonian
film under a light load to the plateau under a heavy one. eta = eta0 exp(alpha p) (Barus 1893), so
that tau0 and alpha are those of the plateau law of Evans and Johnson; the limiting stress bounds
what that viscosity exaggerates at high pressure. tau is averaged over the elliptic pressure of the
contact: at the mean pressure alone, friction under a light load comes out too low by up to half.

The film warms by dT = tau Vs (h/(8 K) + 1.06/2 sqrt(b/V)/sqrt(K' rho' c')) (ibid., eqs. (27) and
(28), two bodies of one material at one speed), and its viscosity falls by exp(-beta_T dT).
"""

from __future__ import annotations

import math
from typing import NamedTuple

from .._compile import law
from .._vector_math import exp, log

# Bounds eta/(tau0 h) to e^200 s/m; long before that the stress is the limiting one.
LARGEST_EXPONENT = 200.0
NEWTONIAN = 1e-5  # asinh(x) is x below, more exactly than by a logarithm


def _hertz_rule() -> tuple[tuple[float, float], tuple[float, float]]:
    """Gauss rule for the mean over a line contact: pressures over the largest one, and weights.

    Moments of p/p0 = sqrt(1 - x^2), the mean of its powers 0 to 3 over x in [0, 1].
    """
    m1, m2, m3 = math.pi / 4.0, 2.0 / 3.0, 3.0 * math.pi / 16.0
    # u^2 + a u + b, orthogonal to 1 and u
    a = (m1 * m2 - m3) / (m2 - m1 * m1)
    b = -m2 - a * m1
    half = math.sqrt(0.25 * a * a - b)
    low, high = -0.5 * a - half, -0.5 * a + half
    weight = (m1 - low) / (high - low)
    return (low, high), (1.0 - weight, weight)


(_LOW, _HIGH), (_LOW_WEIGHT, _HIGH_WEIGHT) = _hertz_rule()


class ShearThinning(NamedTuple):
    """Constants of the film."""

    shear_stress: float  # [Pa] tau0, Eyring stress
    pressure_viscosity: float  # [1/Pa] alpha
    log_shear_time: float  # logarithm of eta0/tau0 in s
    limiting_stress: float  # [-] Lambda, limiting shear stress over pressure
    film_heating: float  # [s/m^2] beta_T tau0/(8 K), of the film by itself
    flash_heating: float  # [(s/m)/(Pa s)^0.5] of its walls, over exp(log_heat)


@law
def film_shear(
    film: ShearThinning,
    load: float,
    area: float,
    log_film: float,
    log_heat: float,
    speed: float,
) -> tuple[float, float]:
    """Friction of the film, and its growth with the sliding speed at the film's temperature.

    Args:
        film: constants of the film.
        load: normal load on the tooth pair [N].
        area: apparent contact area A = 2 b L [m^2]; the mean pressure is load/area.
        log_film: logarithm of the film thickness in metres.
        log_heat: logarithm of sqrt(R p/V) in (Pa s)^0.5, R being the reduced radius of curvature,
            p the mean pressure and V the mean surface speed.
        speed: magnitude of the sliding speed Vs [m/s].

    Returns:
        Magnitude of the friction [N], and its growth [N s/m].
    """
    peak = 4.0 / math.pi * load / area
    heating = film.film_heating * exp(log_film) + film.flash_heating * exp(log_heat)
    softening = heating * speed
    low, low_growth = _stress(film, _LOW * peak, log_film, softening, speed)
    high, high_growth = _stress(film, _HIGH * peak, log_film, softening, speed)
    friction = area * (_LOW_WEIGHT * low + _HIGH_WEIGHT * high)
    return friction, area * (_LOW_WEIGHT * low_growth + _HIGH_WEIGHT * high_growth)


@law
def _stress(
    film: ShearThinning, pressure: float, log_film: float, softening: float, speed: float
) -> tuple[float, float]:
    """Shear stress [Pa] at one pressure [Pa], and its growth with the speed [Pa s/m].

    With x = eta Vs/(h tau0) of the cool film, s = tau/tau0 and c = beta_T dT/s, the warm film has
    sinh(s) = x exp(-c s). One step of Newton from asinh(x) gives asinh(x)/(1 + c tanh(asinh(x))),
    which is exact both for small x and for large x.
    """
    exponent = film.log_shear_time + film.pressure_viscosity * pressure - log_film
    gain = exp(min(exponent, LARGEST_EXPONENT))
    x = gain * speed
    root = math.sqrt(1.0 + x * x)
    inverse = film.shear_stress / (root + softening * x)
    angle = log(x + root) if x > NEWTONIAN else x
    stress, limit = angle * root * inverse, film.limiting_stress * pressure
    return min(stress, limit), gain * inverse if stress < limit else 0.0
