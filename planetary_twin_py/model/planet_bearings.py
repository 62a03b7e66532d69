"""Check of planet bearings against the centrifugal force on a turning carrier."""

from __future__ import annotations

from ..scene import OperatingPoint, SceneError
from .layout import Layout


def check_planet_bearings(layout: Layout, point: OperatingPoint) -> None:
    """Check that the bearings of the planets are stiffer than the centrifugal softening.

    On a carrier that turns at Omega, the centrifugal force on a planet of mass m grows by m Omega^2
    times its outward displacement. A linear bearing with less stiffness has no equilibrium. The
    stiffness of rolling bearings increases with their load.

    Args:
        layout: of the scene; checked only if its axes move, and planets have linear bearings.
        point: operating point, whose speeds are used.

    Raises:
        SceneError: a bearing is too soft.
    """
    scene = layout.scene
    if not scene.moving_axes or scene.supports is None or scene.supports.planet.bearing is None:
        return
    planet, stiffness = scene.supports.planet, scene.supports.planet.bearing
    factors = [scene.errors.of_planet(i).pin_stiffness for i in range(scene.gearset.planets)]
    carrier = layout.speeds_at(point)["carrier"]
    softening = planet.mass * carrier**2
    if stiffness == 0.0 or min(factors) * stiffness > softening:
        return
    raise SceneError(
        f"supports.planet.bearing = {stiffness:g} N/m: must be above "
        f"{softening / min(factors):.4g} N/m where planets of {planet.mass:g} kg turn with the "
        f"carrier at {abs(carrier):.4g} rad/s, or they have no equilibrium"
    )
