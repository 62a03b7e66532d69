"""Commands at the ports of a twin as messages of type JointState."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from ...run.commands import CAUSALITIES, SIDES
from ...scene import Scene
from ...scene.drive import Causality

FIELDS = {"effort": "torque", "velocity": "speed", "position": "position"}


def joint_names(scene: Scene) -> tuple[str, str]:
    """Joints of input and output, as in `joint_states`."""
    return f"{scene.drive.input.member}_joint", f"{scene.drive.output.member}_joint"


def values_by_joint(message: Any) -> dict[str, float]:
    """Efforts, velocities and positions of a message, by joint and quantity: "JOINT/torque".

    Missing values and NaN are ignored, as ros2_control does with interfaces that no controller
    claims.
    """
    return {
        f"{joint}/{quantity}": float(value)
        for field, quantity in FIELDS.items()
        for joint, value in zip(message.name, getattr(message, field), strict=False)
        if not math.isnan(value)
    }


def values_of(message: Any, joints: tuple[str, str]) -> dict[str, float]:
    """Values of both shafts in a message, by the arguments of `Twin.advance`."""
    return values_of_shafts(values_by_joint(message), joints)


def values_of_shafts(values: Mapping[str, float], joints: tuple[str, str]) -> dict[str, float]:
    """Values of both shafts, by the arguments of `Twin.advance`; other joints are ignored.

    Args:
        values: by joint and quantity, from `values_by_joint`.
        joints: joints of input and output.
    """
    return {
        f"{side}_{quantity}": values[f"{joint}/{quantity}"]
        for side, joint in zip(SIDES, joints, strict=True)
        for quantity in FIELDS.values()
        if f"{joint}/{quantity}" in values
    }


def fields_of(values: Mapping[str, float], joints: tuple[str, str]) -> dict[str, Any]:
    """Fields of JointState for values that are given; NaN for those that are not.

    Positions are empty if none is given.
    """
    fields: dict[str, list[float]] = {
        field: [values.get(f"{side}_{quantity}", math.nan) for side in SIDES]
        for field, quantity in FIELDS.items()
    }
    if all(map(math.isnan, fields["position"])):
        fields["position"] = []
    return {"name": list(joints), **fields}


def causality(values: Mapping[str, float]) -> dict[str, Causality]:
    """Ports at which values are given, by the fields of `Ports`."""
    return {side: CAUSALITIES[quantity] for side, quantity in (name.split("_") for name in values)}
