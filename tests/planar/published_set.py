"""The set of the load sharing tests: 30/20/70 teeth, constant stiffness, 63 N m on the sun."""

import math

from planetary_twin_py import Scene, load_scene

MESH, PIN = 2e8, 1e8  # [N/m]
TORQUE = 63.0  # [N m]


def scene(planets, errors=None, sun=0.0, angles=None, **changes) -> Scene:
    """Equal planets, equally spaced where teeth allow; bearing of the sun, the others rigid."""
    base = load_scene("paper")
    placed = angles or [2.0 * math.pi * i / planets for i in range(planets)]
    rigid = {"mass": 1.0, "bearing": 1e14}
    return base.replace(
        **{
            "gearset.planet_angles": placed,
            "mesh.double_pair_ratio": 1.0,
            "mesh.ramp": 0.0,
            "backlash": 1e-4,
            "input_torque": TORQUE,
            "supports": {
                "sun": {"mass": 1.0, "bearing": sun},
                "planet": {"mass": 1.0, "bearing": PIN},
                "ring": rigid,
                "carrier": rigid,
            },
            "errors": errors or {},
        }
        | changes
    )
