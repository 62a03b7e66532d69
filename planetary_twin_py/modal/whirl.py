"""Growth of whirl above a critical speed by damping that turns with the carrier.

Bearings of sun, ring and carrier are at rest in the housing, and damp whirl at any speed. Meshes
and planet bearings turn with the carrier. If it turns faster than an axis whirls forwards, their
damping drives the whirl instead. A rotor of mass m on a bearing k, with the damping c of the
bearing and c_r that turns with it, is stable at speeds W < sqrt(k/m) (1 + c/c_r) (Genta 2005,
Dynamics of Rotating Systems). Here the threshold follows from the eigenvalues of

    M q'' + (G + D) q' + (K - C + N) q = 0

in the frame of the carrier, with G and C of `turning` and the damping D; N is the part of the
damping in the housing that acts on displacements in this frame. Tilts are left out.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from .._core import AXES, damping_time
from ..model.gearbox import Gearbox
from ..model.moving_axes import linear_bearing
from ..model.planar_rows import CENTRAL
from ..scene import OperatingPoint
from ..statics.small_motion import depends_on_load
from ..units.catalogue import SIDES

if TYPE_CHECKING:
    from .springs import SpringModel
    from .turning import Turning


def whirl_warning(gearbox: Gearbox, point: OperatingPoint) -> str:
    """Judge whether small motion about the centred axes grows, where meshes stay in contact.

    Only carriers that turn faster than an axis whirls are judged, on linear bearings.

    Args:
        gearbox: of the scene.
        point: operating point, whose speeds are used.

    Returns:
        A warning with the growth rate; "" if nothing grows.
    """
    scene, supports = gearbox.scene, gearbox.scene.supports
    if not scene.moving_axes or supports is None:
        return ""
    speeds = gearbox.speeds_at(point)
    loaded = any(depends_on_load(getattr(supports, name)) for name in (*CENTRAL, "planet"))
    if speeds["carrier"] == 0.0 or loaded:
        return ""
    # Here, because they load SciPy: other runs need not wait for it.
    from .natural import loaded_planar_model
    from .turning import ROUNDING, turning_terms

    model = loaded_planar_model(scene)
    terms = turning_terms(model, speeds["carrier"], speeds, scene.gearset.planet_angles)
    squares = np.linalg.eigvalsh(model.stiffness - terms.centripetal)
    if squares.min() > -ROUNDING * squares.max():
        return ""
    found = growing(model, terms, *_damping(gearbox, point, model, speeds["carrier"]))
    if found is None:
        return ""
    return (
        f"the carrier turns at {abs(speeds['carrier']):.4g} rad/s, above a critical speed of its "
        "bearings, and the motion is not stable there: a whirl of "
        f"{abs(found.imag) / (2.0 * math.pi):.3g} Hz in the frame of the carrier grows with "
        f"{found.real:.3g} 1/s, until teeth or clearances stop it; reduce the speed, or give sun, "
        "ring and carrier stiffer bearings or more damping (supports.*.damping)"
    )


def _damping(
    gearbox: Gearbox, point: OperatingPoint, model: SpringModel, carrier: float
) -> tuple[np.ndarray, np.ndarray]:
    """D [N s/m] and N [N/m], (n, n) each."""
    train = gearbox.held.train
    speeds = np.zeros(AXES)
    speeds[:] = point.input_speed, point.second_input_speed
    rate = abs(float(train.cycle.per_turn @ speeds)) / (2.0 * math.pi)
    tau = {kind: damping_time(train, k, rate) for k, kind in enumerate(SIDES)}
    torque = gearbox.scene.operating_point.input_torque
    dampers = {name: linear_bearing(gearbox, name, torque)[1] for name in gearbox.bearings}
    pins = iter([dampers[planet] for planet in gearbox.planets for _ in "xy"])
    damping, turned = np.zeros((2, len(model.coordinates), len(model.coordinates)))
    for spring in model.springs:
        body, _, part = spring.kind.partition("_")
        if spring.kind in tau:
            damping += tau[spring.kind] * spring.stiffness * np.outer(spring.row, spring.row)
        elif part == "bearing":
            damper = next(pins) if body == "planet" else dampers[body]
            damping += damper * np.outer(spring.row, spring.row)
    place = {name: k for k, name in enumerate(model.coordinates)}
    for body in CENTRAL:
        a, b = place[f"{body}.x"], place[f"{body}.y"]
        turned[a, b], turned[b, a] = -carrier * dampers[body], carrier * dampers[body]
    return damping, turned


def growing(
    model: SpringModel, terms: Turning, damping: np.ndarray, turned: np.ndarray
) -> complex | None:
    """Eigenvalue of the fastest growth.

    Args:
        model: masses and springs.
        terms: gyroscopic and centripetal terms.
        damping: D [N s/m], (n, n).
        turned: N [N/m], (n, n).

    Returns:
        Growth and angular frequency in the frame of the carrier [1/s]; None if nothing grows.
    """
    from .turning import ROUNDING, factors, system

    unit = 1.0 / np.sqrt(np.outer(model.mass, model.mass))
    _, springs, signs = factors(model, terms)
    matrix = system((terms.gyroscopic + damping) * unit, springs, signs)
    size = len(unit)
    displacement = springs.T / (springs**2).sum(axis=1)  # of z = S y
    matrix[:size, size:] -= (turned * unit) @ displacement
    values = np.linalg.eigvals(matrix)
    found = values[np.argmax(values.real)]
    return complex(found) if found.real > ROUNDING * np.abs(values).max() else None
