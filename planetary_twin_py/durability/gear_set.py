"""What makes a gear set another one, so that its damage is not that of this one."""

from __future__ import annotations

import json
from hashlib import sha256

from ..scene import Scene

_MASSES = {"equivalent_mass", "inertia", "planet_mass"}
_PARTS = ("material", "bearings", "shafts", "face_load_factor")


def gear_set_digest(scene: Scene) -> str:
    """Digest of gears, materials and bearings.

    Masses, friction, drive, faults and the operating point are not in it: they may change while the
    parts stay the same. Fields that have their defaults are not in it either, so that a later
    version may add fields.

    Args:
        scene: scene of the gearbox.

    Returns:
        16 hexadecimal digits.
    """
    given = scene.model_dump(mode="json", exclude_defaults=True)
    durability = given.get("durability") or {}
    counted = {
        "gearset": {k: v for k, v in given["gearset"].items() if k not in _MASSES},
        "tip_relief": given["mesh"].get("tip_relief"),
        "durability": {name: durability.get(name) for name in _PARTS},
    }
    return sha256(json.dumps(counted, sort_keys=True).encode()).hexdigest()[:16]
