"""Film and friction of one tooth pair: the laws of `lubrication` put together."""

from __future__ import annotations

from .._compile import law
from .._records import Record
from ..lubrication.boundary import boundary_shear
from ..lubrication.film import SLOWEST_SPEED, film_thickness
from ..lubrication.hertz import half_width
from ..lubrication.traction import sliding_sense, viscous_friction

LIGHTEST_LOAD = 1e-6  # [N] keeps logarithms finite; friction vanishes with the load


@law
def tooth_contact(
    oil: Record,
    rho1: float,
    rho2: float,
    external: float,
    speed1: float,
    speed2: float,
    load: float,
    lambda_ratio: float,
) -> tuple[float, float, float, float, float, float, float]:
    """Friction of a tooth pair, positive against the sliding of the first flank on the second.

    Args:
        oil: laws and constants.
        rho1, rho2: radii of curvature of the two flanks [m].
        external: +1 for an external mesh, -1 for an internal one.
        speed1, speed2: speeds of the two gears relative to the carrier [rad/s].
        load: normal load of the pair [N].
        lambda_ratio: specific film thickness, used where the scene prescribes it.

    Returns:
        Signed friction [N], boundary and viscous friction [N], film [m], lambda ratio [-],
        sliding speed [m/s], growth of the friction with the sliding speed [N s/m].
    """
    u1, u2 = rho1 * speed1, -external * rho2 * speed2
    sliding = u1 - u2
    speed = max(abs(0.5 * (u1 + u2)), SLOWEST_SPEED)
    radius = rho1 * rho2 / (rho2 + external * rho1)
    load = max(load, LIGHTEST_LOAD)
    modulus = 2.0 * oil.contact_modulus
    film = film_thickness(
        oil.film,
        radius,
        oil.viscosity * speed / (modulus * radius),
        oil.traction.pressure_viscosity * modulus,
        load / (modulus * radius * oil.face_width),
    )
    area = 2.0 * oil.face_width * half_width(load, radius, oil.face_width, oil.contact_modulus)
    ratio = lambda_ratio if oil.prescribed else film / oil.roughness
    sense = sliding_sense(sliding, speed, oil.sliding_threshold)
    boundary = boundary_shear(oil.asperities, ratio) * area
    viscous = viscous_friction(oil.traction, load, area, radius, film, speed)
    full = boundary + viscous
    slope = full * (1.0 - sense * sense) / (oil.sliding_threshold * speed)
    return full * sense, boundary, viscous, film, ratio, sliding, slope
