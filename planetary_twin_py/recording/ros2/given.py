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


def values_of(message: Any, joints: tuple[str, str]) -> dict[str, float]:
    """Efforts, velocities and positions of both shafts, by the arguments of `Twin.advance`.

    Other joints, missing values and NaN are ignored, as ros2_control does with interfaces that no
    controller claims.
    """
    values_by_name, names = {}, list(message.name)
    for side, joint in zip(SIDES, joints, strict=True):
        if joint not in names:
            continue
        joint_index = names.index(joint)
        for field, quantity in FIELDS.items():
            values = getattr(message, field)
            if joint_index < len(values) and not math.isnan(values[joint_index]):
                values_by_name[f"{side}_{quantity}"] = float(values[joint_index])
    return values_by_name


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
