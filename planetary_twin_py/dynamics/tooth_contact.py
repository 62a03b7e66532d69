"""Film and friction of one tooth pair: the laws of `lubrication` put together."""

from __future__ import annotations

from .._compile import law
from .._records import Record
from ..lubrication.boundary import boundary_shear
from ..lubrication.film import SLOWEST_SPEED, film_thickness
from ..lubrication.hertz import half_width
from ..lubrication.load_sharing import film_share
from ..lubrication.rolling import rolling_resistance
from ..lubrication.traction import sliding_sense, viscous_friction

LIGHTEST_LOAD = 1e-6  # [N] keeps logarithms finite


@law
def choices(oil: Record) -> tuple[bool, bool, bool, bool]:
    """Prescribed lambda ratio, printed asperity functions, load sharing, rolling resistance."""
    return oil.prescribed, oil.printed_asperities, oil.sharing, oil.rolling


@law
def tooth_contact(
    oil: Record,
    laws: tuple[bool, bool, bool, bool],
    pair: tuple[float, float, float, float, float, float],
    lambda_ratio: float,
) -> tuple[float, float, float, float, float, float, float, float]:
    """Friction of a tooth pair, positive against the sliding of the first flank on the second.

    Args:
        oil: constants of the laws.
        laws: what `choices` reads from it. Kept apart so that they are known not to change within
            a loop over pairs, from which the compiler then takes their branches out.
        pair: radii of curvature of both flanks [m], +1 for an external mesh and -1 for an
            internal one, speeds of both gears relative to the carrier [rad/s], normal load [N].
        lambda_ratio: specific film thickness, used where the scene prescribes it.

    Returns:
        Signed friction [N], boundary and viscous friction [N], film [m], lambda ratio [-],
        sliding speed [m/s], growth of the friction with the sliding speed [N s/m], rolling
        resistance [N] against the mean motion of both flanks.
    """
    prescribed, printed, sharing, resists = laws
    rho1, rho2, external, speed1, speed2, load = pair
    u1, u2 = rho1 * speed1, -external * rho2 * speed2
    sliding = u1 - u2
    speed = max(abs(0.5 * (u1 + u2)), SLOWEST_SPEED)
    radius = rho1 * rho2 / (rho2 + external * rho1)
    # Friction vanishes with the load: a jump where flanks meet would have them chatter.
    fade = load / (load + LIGHTEST_LOAD)
    load = max(load, LIGHTEST_LOAD)
    modulus = 2.0 * oil.contact_modulus
    speed_group = oil.viscosity * speed / (modulus * radius)
    material_group = oil.traction.pressure_viscosity * modulus
    load_group = load / (modulus * radius * oil.face_width)
    film = film_thickness(oil.film, radius, speed_group, material_group, load_group)
    area = 2.0 * oil.face_width * half_width(load, radius, oil.face_width, oil.contact_modulus)
    ratio = lambda_ratio if prescribed else film / oil.roughness
    sense = sliding_sense(sliding, speed, oil.sliding_threshold)
    viscous = viscous_friction(oil.traction, load, area, radius, film, speed)
    if sharing:
        share = film_share(ratio)
        boundary = (1.0 - share) * oil.boundary_coefficient * load
        viscous *= share
    else:
        boundary = boundary_shear(oil.asperities, printed, ratio) * area
    full = (boundary + viscous) * fade
    slope = full * (1.0 - sense * sense) / (oil.sliding_threshold * speed)
    rolling = 0.0
    if resists:
        size = radius * oil.face_width / oil.traction.pressure_viscosity
        rolling = rolling_resistance(size, speed_group, material_group, load_group)
        # The formula is one of loaded films, and would act with no load at all.
        rolling /= 1.0 + rolling / load
        rolling *= fade * sliding_sense(u1 + u2, SLOWEST_SPEED, 1.0)
    return full * sense, boundary, viscous, film, ratio, sliding, slope, rolling
