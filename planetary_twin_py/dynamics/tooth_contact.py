"""Film and friction of one tooth pair: the laws of `lubrication` put together."""

from __future__ import annotations

from .._compile import law
from .._records import Record
from .._vector_math import exp, logs
from ..lubrication.boundary import boundary_shear
from ..lubrication.film import SLOWEST_SPEED, log_film_thickness
from ..lubrication.hertz import half_width
from ..lubrication.load_sharing import film_share
from ..lubrication.rolling import rolling_resistance
from ..lubrication.traction import sliding_sense, viscous_friction

LIGHTEST_LOAD = 1e-6  # [N] keeps logarithms finite
SLOWEST_ROLLING = 1e-9  # [m/s] below it the sense of sliding fades out; see also `bristles`


@law
def choices(oil: Record) -> tuple[bool, bool, bool, bool]:
    """Prescribed lambda ratio, printed asperity functions, load sharing, rolling resistance."""
    return oil.prescribed, oil.printed_asperities, oil.sharing, oil.rolling


@law
def lambda_ratio_of(oil: Record, prescribed: bool, log_film: float) -> float:
    """Specific film thickness [-]: as given, or film over roughness."""
    return oil.lambda_ratio if prescribed else exp(log_film - oil.log_roughness)


@law
def tooth_contact(
    oil: Record,
    laws: tuple[bool, bool, bool, bool],
    pair: tuple[float, float, float, float, float, float],
) -> tuple[float, float, float, float, float, float, float, float]:
    """Friction of a tooth pair, positive against the sliding of the first flank on the second.

    Args:
        oil: constants of the laws.
        laws: what `choices` reads from it. Kept apart so that they are known not to change within
            a loop over pairs, from which the compiler then takes their branches out.
        pair: radii of curvature of both flanks [m], +1 for an external mesh and -1 for an
            internal one, speeds of both gears relative to the carrier [rad/s], normal load [N].

    Returns:
        Signed friction [N], boundary and viscous friction [N], logarithm of the film in metres,
        sliding speed [m/s], growth of the friction with the sliding speed [N s/m], rolling
        resistance [N] against the mean motion of both flanks, and the power that takes [W].
    """
    prescribed, printed, sharing, resists = laws
    rho1, rho2, external, speed1, speed2, load = pair
    u1, u2 = rho1 * speed1, -external * rho2 * speed2
    sliding = u1 - u2
    rolling_speed = abs(0.5 * (u1 + u2))
    speed = max(rolling_speed, SLOWEST_SPEED)
    # Three divisions in one, as they take longest of all in a loop over pairs.
    distance, loaded = rho2 + external * rho1, load + LIGHTEST_LOAD
    threshold = oil.sliding_threshold * max(rolling_speed, SLOWEST_ROLLING)
    inverse = 1.0 / (distance * loaded * threshold)
    radius = rho1 * rho2 * (loaded * threshold * inverse)
    steepness = distance * loaded * inverse
    # Friction vanishes with the load: a jump where flanks meet would have them chatter.
    fade = load * (distance * threshold * inverse)
    load = max(load, LIGHTEST_LOAD)
    log_radius, log_speed, log_load = logs(radius, speed, load)
    log_group = log_speed - log_radius + oil.log_speed_group  # of U
    log_load_group = log_load - log_radius + oil.log_load_group  # of W
    film = log_film_thickness(oil.film, log_radius, log_group, oil.log_material, log_load_group)
    area = 2.0 * oil.face_width * half_width(load, radius, oil.face_width, oil.contact_modulus)
    sense = sliding_sense(sliding * steepness)
    # sqrt(R F/(A V)) of (13), A being proportional to sqrt(R F)
    log_heat = 0.25 * (log_radius + log_load) - 0.5 * (log_speed + oil.log_area)
    viscous = viscous_friction(oil.traction, load, area, film, log_heat)
    if sharing:
        share = film_share(lambda_ratio_of(oil, prescribed, film))
        boundary = (1.0 - share) * oil.boundary_coefficient * load
        viscous *= share
    else:
        # At a prescribed ratio it is the same for all pairs.
        ratio = lambda_ratio_of(oil, prescribed, film)
        shear = oil.asperity_shear if prescribed else boundary_shear(oil.asperities, printed, ratio)
        boundary = shear * area
    boundary *= fade
    viscous *= fade
    full = boundary + viscous
    slope = full * (1.0 - sense * sense) * steepness
    rolling = taken = 0.0
    if resists:
        size = radius * oil.face_width / oil.traction.pressure_viscosity
        rolling = rolling_resistance(size, log_group, oil.log_material, log_load_group)
        # The formula is one of loaded films, and would act with no load at all.
        rolling /= 1.0 + rolling / load
        rolling *= fade * sliding_sense((u1 + u2) / SLOWEST_SPEED)
        taken = rolling * (u1 + u2)
    return full * sense, boundary, viscous, film, sliding, slope, rolling, taken
