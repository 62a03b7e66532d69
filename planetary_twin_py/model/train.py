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
from .bodies import Bodies
from .drag import build_drag
from .layout import Layout
from .library import library
from .meshes import build_meshes
from .moving_axes import moving_fields


def build_train(layout: Layout, bodies: Bodies) -> Train:
    """Translate a scene into arrays, which do not depend on quantities that may change in a run.

    Where axes move, the record is that of `_core.axes`, see `moving_axes`.

    Args:
        layout: of the scene.
        bodies: of the layout.

    Returns:
        The record.

    Raises:
        ValueError: there is an instant without contact of teeth (see `pair_table`).
    """
    scene = layout.scene
    meshes = build_meshes(layout, bodies)
    pitch = meshes["base_pitch"]
    fields = {
        "bodies": bodies.ground,
        "axes": len(scene.drive.inputs),
        "body_copies": bodies.copies,
        "mass": bodies.copies * bodies.mass,
        "radius": bodies.radius,
        "inverse_radius": 1.0 / bodies.radius,
        "ratio": bodies.ratio,
        "sun": bodies.place["sun"],
        "carrier": bodies.place["carrier"],
        "sun_advance": 1.0 / pitch,
        "carrier_advance": -layout.radii["sun"] / layout.radii["carrier"] / pitch,
        "friction": scene.lubrication.friction,
        "printed_torque": scene.lubrication.friction_torque == "printed",
        **_cycles(layout),
        **_couplings(layout, bodies),
        "lever": 1.0 / bodies.radius[np.asarray(meshes["body"])].T,
        **meshes,
        **build_drag(layout, bodies),
    }
    if scene.moving_axes:
        fields = moving_fields(layout, bodies, fields)
    fields["spin_ratio"] = _spin_ratio(fields)
    lanes = _whole_registers(max(fields["bodies"], fields["meshes"]))
    train: Train = library(scene).Train(**fields, lanes=lanes)
    return train


def _spin_ratio(fields: dict[str, Any]) -> np.ndarray:
    """Rigid speeds of the gears of meshes relative to the carrier, a row for each input."""
    ratio, body = np.asarray(fields["ratio"]), np.asarray(fields["body"])
    spin: np.ndarray = ratio[body[:, :2]] - ratio[body[:, 2:3]]
    return spin.transpose(1, 2, 0)


def lightest_body(train: Train) -> float:
    """Least J/r^2 [kg] of a single body."""
    own = slice(train.bodies)
    return float((train.mass[own] / train.body_copies[own]).min())


def _whole_registers(count: int) -> int:
    return -(-count // REGISTER) * REGISTER


def _cycles(layout: Layout) -> dict[str, Any]:
    """Mesh cycles per turn of each input, as fractions, so that whole turns add no error."""
    cycles = layout.cycles
    denominators = np.ones(AXES, dtype=int)
    denominators[: len(cycles)] = [cycle.denominator for cycle in cycles]
    return {
        "cycles": np.array([float(cycle) for cycle in cycles]),
        "cycles_numerator": np.array([cycle.numerator for cycle in cycles]),
        "cycles_denominator": denominators,
    }


def _couplings(layout: Layout, bodies: Bodies) -> dict[str, Any]:
    """Elastic couplings between the machines and their members."""
    found, place = layout.machines, bodies.place
    squares = np.array([layout.radii[machine.member] ** 2 for machine in found.values()])
    stiffness = np.array([machine.coupling_stiffness for machine in found.values()])
    damping = np.array([machine.coupling_damping for machine in found.values()])
    return {
        "machines": len(found),
        "coupling": np.array([[place[name], place[m.member]] for name, m in found.items()]),
        "coupling_stiffness": stiffness / squares,
        "coupling_damping": damping / squares,
    }
