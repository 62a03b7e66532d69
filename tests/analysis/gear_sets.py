"""Scenes of gear sets whose orders of faults are known."""

import planetary_twin_py as pt

PAPER = pt.load_scene("paper")
SHIFTED = {
    (31, 31, 95): {"centre_distance": "31.5 mm"},
    (21, 31, 84): {"profile_shift": {"sun": 0.25, "planet": 0.25, "ring": -0.25}},
}


def gear_set(teeth, planets=3, held="ring", angles=None, **fields):
    """A scene with these teeth, equally spaced planets unless given, driven at the sun or ring."""
    driver, driven = {
        "ring": ("sun", "carrier"), "carrier": ("sun", "ring"), "sun": ("ring", "carrier")
    }[held]  # fmt: skip
    own = {
        "teeth": dict(zip(("sun", "planet", "ring"), teeth, strict=True)),
        "planet_angles": angles or [f"{360 * i / planets:.12g} deg" for i in range(planets)],
        "module": "1 mm",
        "held": held,
        **SHIFTED.get(tuple(teeth), {}),
    }
    return PAPER.replace(
        **{f"gearset.{name}": value for name, value in own.items()},
        **{"drive.input.member": driver, "drive.output.member": driven},
        **fields,
    )
