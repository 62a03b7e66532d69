"""Film and friction of one tooth pair: the laws of `lubrication` put together."""

from __future__ import annotations

import math

from .._compile import law
from .._records import Record
from .._vector_math import exp, logs
from ..lubrication.boundary import boundary_shear
from ..lubrication.film import LOG_THINNEST, SLOWEST_SPEED, STANDSTILL, log_film_thickness
from ..lubrication.hertz import half_width
from ..lubrication.load_sharing import film_share
from ..lubrication.rolling import rolling_resistance
from ..lubrication.schlenk import schlenk_coefficient
from ..lubrication.shear_thinning import film_shear
from ..lubrication.traction import EYRING, SCHLENK, sliding_sense, viscous_friction
from .creep import CREEPING

LIGHTEST_LOAD = 1e-6  # [N] keeps logarithms finite
SLOWEST_ROLLING = 1e-9  # [m/s] below it the sense of sliding fades out; see also `bristles`
_LOG_SLOWEST = math.log(SLOWEST_SPEED)

Laws = tuple[bool, bool, bool, bool, int]  # what `choices` returns


@law
def choices(oil: Record) -> Laws:
    """Prescribed lambda ratio, printed asperities, load sharing, rolling resistance, traction."""
    return oil.prescribed, oil.printed_asperities, oil.sharing, oil.rolling, oil.traction_law


@law
def lambda_ratio_of(oil: Record, prescribed: bool, log_film: float) -> float:
    """Specific film thickness [-]: as given, or film over roughness."""
    return oil.lambda_ratio if prescribed else exp(log_film - oil.log_roughness)


@law
def tooth_contact(
    oil: Record,
    laws: Laws,
    pair: tuple[float, float, float, float, float, float],
    slowest_rolling: float = SLOWEST_ROLLING,
) -> tuple[float, float, float, float, float, float, float, float]:
    """Friction of a tooth pair, positive against the sliding of the first flank on the second.

    Args:
        oil: constants of the laws.
        laws: what `choices` reads from it. Kept apart so that they are known not to change within
            a loop over pairs, from which the compiler then takes their branches out.
        pair: radii of curvature of both flanks [m], +1 for an external mesh and -1 for an
            internal one, speeds of both gears relative to the carrier [rad/s], normal load [N].
        slowest_rolling: rolling speed [m/s] that sets the least width of the layer in which
            friction reverses.

    Returns:
        Signed friction [N], boundary and viscous friction [N], logarithm of the film in metres,
        sliding speed [m/s], growth of the friction with the sliding speed [N s/m], rolling
        resistance [N] against the mean motion of both flanks, and the power that takes [W].
    """
    resists, traction = laws[3], laws[4]
    rho1, rho2, external, speed1, speed2, load = pair
    u1, u2 = rho1 * speed1, -external * rho2 * speed2
    sliding = u1 - u2
    speed = abs(0.5 * (u1 + u2))
    # Three divisions in one, as they take longest of all in a loop over pairs.
    distance, loaded = rho2 + external * rho1, load + LIGHTEST_LOAD
    threshold = oil.sliding_threshold * max(speed, slowest_rolling)
    inverse = 1.0 / (distance * loaded * threshold)
    radius = rho1 * rho2 * (loaded * threshold * inverse)
    steepness = distance * loaded * inverse
    # Friction vanishes with the load: a jump where flanks meet would have them chatter.
    fade = load * (distance * threshold * inverse)
    load = max(load, LIGHTEST_LOAD)
    log_radius, log_speed, log_load = logs(radius, max(speed, STANDSTILL), load)
    log_group = log_speed - log_radius + oil.log_speed_group  # of U
    log_load_group = log_load - log_radius + oil.log_load_group  # of W
    film = log_film_thickness(oil.film, log_radius, log_group, oil.log_material, log_load_group)
    area = 2.0 * oil.face_width * half_width(load, radius, oil.face_width, oil.contact_modulus)
    # Where gears creep, bristles decide how much of the friction of a sliding contact acts.
    slowest = oil.sliding_threshold * CREEPING if speed < CREEPING else STANDSTILL
    shear = max(abs(sliding), slowest)
    boundary, viscous, growth = _friction(
        oil, laws, (load, area, shear), (log_radius, log_speed, log_load, film)
    )
    softer = 0.0  # by what the friction grows with the sliding, its sense is less steep
    if traction == EYRING:
        # Up to the friction, flanks and film yield elastically: less friction needs less sliding.
        scale = oil.shear_thinning.limiting_stress * load / (boundary + viscous)
        steepness *= max(scale, 1.0)
        softer = growth * shear if scale > 1.0 else 0.0
    sense = sliding_sense(max(abs(sliding), STANDSTILL) * steepness)
    boundary *= fade
    viscous *= fade
    full = boundary + viscous
    slope = (full - fade * softer) * (1.0 - sense * sense) * steepness + fade * growth * sense
    sense *= min(max(sliding * (1.0 / STANDSTILL), -1.0), 1.0)
    rolling = taken = 0.0
    if resists:
        size = radius * oil.face_width / oil.traction.pressure_viscosity
        rolling = rolling_resistance(size, log_group, oil.log_material, log_load_group)
        # The formula is one of loaded films, and would act with no load at all.
        rolling /= 1.0 + rolling / load
        rolling *= fade * sliding_sense((u1 + u2) / SLOWEST_SPEED)
        taken = rolling * (u1 + u2)
    film = max(film, LOG_THINNEST)
    return full * sense, boundary, viscous, film, sliding, slope, rolling, taken


@law
def _friction(
    oil: Record,
    laws: Laws,
    contact: tuple[float, float, float],
    logarithms: tuple[float, float, float, float],
) -> tuple[float, float, float]:
    """Magnitudes of the friction of a tooth pair by the laws chosen, at its sliding speed.

    Args:
        oil: constants of the laws.
        laws: what `choices` reads from it.
        contact: normal load [N], apparent area [m^2], magnitude of the sliding speed [m/s].
        logarithms: of the reduced radius of curvature in m, of the mean surface speed in m/s, of
            the load in N, of the film in m.

    Returns:
        Boundary friction [N], viscous friction [N], growth of the latter with the sliding speed
        [N s/m].
    """
    prescribed, printed, sharing, _, traction = laws
    load, area, speed = contact
    log_radius, log_speed, log_load, film = logarithms
    log_moving = max(log_speed, _LOG_SLOWEST)  # both laws that divide by it are of moving flanks
    if traction == SCHLENK:  # a regression that has boundary friction in it
        mu = schlenk_coefficient(oil.log_schlenk, log_load, log_moving, log_radius)
        return 0.0, mu * load, 0.0
    # sqrt(R F/(A V)) of (13), A being proportional to sqrt(R F)
    log_heat = 0.25 * (log_radius + log_load) - 0.5 * (log_moving + oil.log_area)
    if traction == EYRING:
        viscous, growth = film_shear(oil.shear_thinning, load, area, film, log_heat, speed)
    else:
        film_left = max(film, LOG_THINNEST)
        viscous, growth = viscous_friction(oil.traction, load, area, film_left, log_heat), 0.0
    if sharing:
        share = film_share(oil.log_lambda if prescribed else film - oil.log_roughness)
        return (1.0 - share) * oil.boundary_coefficient * load, share * viscous, share * growth
    # At a prescribed ratio it is the same for all pairs.
    ratio = lambda_ratio_of(oil, prescribed, max(film, LOG_THINNEST))
    shear = oil.asperity_shear if prescribed else boundary_shear(oil.asperities, printed, ratio)
    return shear * area, viscous, growth
