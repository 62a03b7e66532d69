"""The gearbox as arrays for the compiled equations: bodies, meshes, couplings.

Coordinates. Every body has x = r theta, r its base radius (r_c cos(phi) for the carrier; that of
its member for a machine), measured in a frame that turns with the rigid train at the speeds of the
motors. A mesh's transmission error is then a sum of three x with signs: d = x_s + x_p - x_c at the
sun, d = -x_p + x_r - x_c at the ring (al-Shyyab and Kahraman 2007, in base-circle coordinates).
Where ring is not sun + 2 planet, x_c has the factor (r_br - r_bp)/(r_bs + r_bp) at the ring.
A held body is the ground: one additional entry with x = 0.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from .._core import AXES, REGISTER, Train
from ..durability.parts import MEMBERS
from .bodies import Bodies
from .damage import put_durability
from .drag import build_drag
from .layout import Layout
from .library import library
from .meshes import build_meshes
from .moving_axes import move_axes


def build_train(layout: Layout, bodies: Bodies) -> Train:
    """Translate a scene into arrays, which do not depend on quantities that may change in a run.

    Where axes move, the record is that of `_core.axes`, see `moving_axes`.

    Args:
        layout: of the scene.
        bodies: of the layout.

    Raises:
        ValueError: there is an instant without contact of teeth (see `pair_table`).
    """
    scene = layout.scene
    groups = {
        "body": _body_arrays(bodies),
        "coupling": _couplings(layout, bodies),
        "cycle": _cycles(layout),
        **build_meshes(layout, bodies),
        **build_drag(layout, bodies),
    }
    moving = move_axes(layout, bodies, groups) if scene.moving_axes else None
    groups["mesh"]["spin_ratio"] = _spin_ratio(groups["body"]["ratio"], groups["mesh"]["body"])
    meshes = len(groups["mesh"]["kind"])
    train: Train = library(scene).Train(
        bodies=bodies.ground,
        meshes=meshes,
        lanes=-(-max(bodies.ground, meshes) // REGISTER) * REGISTER,
        axes=len(scene.drive.inputs),
        machines=len(layout.machines),
        sun=bodies.place["sun"],
        carrier=bodies.place["carrier"],
        friction=scene.lubrication.friction,
        printed_torque=scene.lubrication.friction_torque == "printed",
    )
    for group, fields in groups.items():
        for name, value in fields.items():
            setattr(getattr(train, group), name, value)
    if moving is not None:
        train.moving = moving
    put_durability(scene, train)
    train.durability.member_body = [bodies.place[member] for member in MEMBERS]
    return train


def _body_arrays(bodies: Bodies) -> dict[str, Any]:
    return {
        "copies": bodies.copies,
        "mass": bodies.copies * bodies.mass,
        "radius": bodies.radius,
        "inverse_radius": 1.0 / bodies.radius,
        "ratio": bodies.ratio,
    }


def _spin_ratio(ratio: np.ndarray, body: np.ndarray) -> np.ndarray:
    """Rigid speeds of the gears of meshes relative to the carrier, a row for each input."""
    spin: np.ndarray = ratio[body[:, :2]] - ratio[body[:, 2:3]]
    return spin.transpose(1, 2, 0)


def lightest_body(train: Train) -> float:
    """Least J/r^2 [kg] of a single body."""
    own = slice(train.bodies)
    return float((train.body.mass[own] / train.body.copies[own]).min())


def _cycles(layout: Layout) -> dict[str, Any]:
    """How the meshes go through their cycles.

    Cycles per turn of each input are fractions, so that whole turns add no error.
    """
    cycles, pitch = layout.cycles, layout.scene.gearset.geometry.meshes[0].base_pitch
    denominators = np.ones(AXES, dtype=int)
    denominators[: len(cycles)] = [cycle.denominator for cycle in cycles]
    return {
        "per_turn": np.array([float(cycle) for cycle in cycles]),
        "numerator": np.array([cycle.numerator for cycle in cycles]),
        "denominator": denominators,
        "sun_advance": 1.0 / pitch,
        "carrier_advance": -layout.radii["sun"] / layout.radii["carrier"] / pitch,
    }


def _couplings(layout: Layout, bodies: Bodies) -> dict[str, Any]:
    """Elastic couplings between the machines and their members."""
    found, place = layout.machines, bodies.place
    squares = np.array([layout.radii[machine.member] ** 2 for machine in found.values()])
    stiffness = np.array([machine.coupling_stiffness for machine in found.values()])
    damping = np.array([machine.coupling_damping for machine in found.values()])
    return {
        "ends": np.array([[place[name], place[m.member]] for name, m in found.items()]),
        "stiffness": stiffness / squares,
        "damping": damping / squares,
    }
