"""Drag outside the tooth contacts: bearings, and members that churn oil."""

from __future__ import annotations

import math

import numpy as np

from .._compile import kernel, law
from .._records import BODIES, REAL, WHOLE, Record
from ..losses.bearing import bearing_torque
from ..losses.churning import disc_torque
from ..scene import Scene
from .alike import planet_groups
from .bodies import Bodies
from .body_speed import body_speed
from .state import BEARING, CHURNING

MEMBERS = ("sun", "ring", "carrier")
SLOWEST_TURN = 1e-2  # [rad/s] below which the sense of drag fades out
NO_PLANET = -1

DRAG_LAYOUT = {
    "bearings": WHOLE,
    "bearing_body": (WHOLE, (BODIES, 2)),  # whose inner and outer ring
    "bearing_planet": (WHOLE, (BODIES,)),  # whose pin loads it, or NO_PLANET
    "bearing_idle": (REAL, (BODIES,)),  # f0 dm^3 [m^3]
    "bearing_rubbing": (REAL, (BODIES,)),  # f1 dm [m]
    "pin_share": REAL,  # load on a pin per sum of the forces of its planet's meshes [-]
    "discs": WHOLE,
    "disc_body": (WHOLE, (len(MEMBERS),)),
    "disc_radius": (REAL, (len(MEMBERS),)),  # [m]
    "disc_gap": REAL,  # [m]
    "disc_fill": REAL,  # share of oil in what they turn in [-]
}


def build_drag(scene: Scene, bodies: Bodies) -> dict[str, object]:
    """Fields of `DRAG_LAYOUT`."""
    losses, place, ground, rows = scene.losses, bodies.place, len(bodies.mass) - 1, []
    if losses.planet_bearing is not None:
        for i, leader in enumerate(planet_groups(scene).leaders):
            rings = (place[f"planet_{leader + 1}"], place["carrier"])
            rows.append((losses.planet_bearing, rings, i))
    for member in MEMBERS:
        bearing = getattr(losses, f"{member}_bearing")
        if bearing is not None:
            rows.append((bearing, (place[member], ground), NO_PLANET))
    churning = losses.churning
    discs = {m: getattr(churning, m) for m in MEMBERS if churning and getattr(churning, m)}
    return {
        "bearings": len(rows),
        "bearing_body": np.array([rings for _, rings, _ in rows], dtype=int).reshape(-1, 2),
        "bearing_planet": np.array([planet for _, _, planet in rows], dtype=int),
        "bearing_idle": np.array([b.f0 * b.mean_diameter**3 for b, _, _ in rows]),
        "bearing_rubbing": np.array([b.f1 * b.mean_diameter for b, _, _ in rows]),
        "pin_share": math.cos(scene.gearset.pressure_angle),
        "discs": len(discs),
        "disc_body": np.array([place[member] for member in discs], dtype=int),
        "disc_radius": np.array(list(discs.values()), dtype=float),
        "disc_gap": churning.gap if churning else 0.0,
        "disc_fill": churning.fill if churning else 0.0,
    }


@law
def _sense(speed: float) -> float:
    return speed / math.sqrt(speed * speed + SLOWEST_TURN * SLOWEST_TURN)


@kernel
def apply_drag(model: Record, state: Record, v: np.ndarray, out: Record) -> None:
    """Add the drag of bearings and discs to out.rubbing; book it in out.power.

    Reads the pushes of the meshes from `out.now`.
    """
    train, oil = model.train, model.oil
    planets = train.meshes // 2
    for b in range(train.bearings):
        inner, outer, planet = (
            train.bearing_body[b, 0],
            train.bearing_body[b, 1],
            train.bearing_planet[b],
        )
        load = 0.0
        if planet != NO_PLANET:
            load = train.pin_share * abs(
                state.side[planet] * out.now.push[planet]
                + state.side[planets + planet] * out.now.push[planets + planet]
            )
        speed = body_speed(train, state, v, inner) - body_speed(train, state, v, outer)
        torque = bearing_torque(
            train.bearing_idle[b], train.bearing_rubbing[b], oil.kinematic, speed, load
        ) * _sense(speed)
        torque *= train.body_copies[inner]
        out.rubbing[inner] -= torque / train.radius[inner]
        out.rubbing[outer] += torque / train.radius[outer]
        out.power[BEARING] += torque * speed
    for n in range(train.discs):
        body, radius = train.disc_body[n], train.disc_radius[n]
        speed = body_speed(train, state, v, body)
        density = train.disc_fill * oil.density
        torque = disc_torque(radius, train.disc_gap / radius, density, oil.kinematic, speed)
        torque *= _sense(speed)
        out.rubbing[body] -= torque / train.radius[body]
        out.power[CHURNING] += torque * speed
