"""Parts of a gearbox that collect damage."""

from __future__ import annotations

from ..scene import Scene
from ..scene.given import check_scene


def part_names(scene: Scene) -> tuple[str, ...]:
    """Names of the parts that collect damage in a scene.

    Teeth first, from sun to ring: their flanks (contact) and roots (bending), then planet bearings.
    `drive` is the flank that carries under positive torque of the sun; `planet_k_flank_sun` is the
    flank of planet k that then meets the sun. Roots are those of external spur teeth, for which
    there are form factors: others, and bearings without a rating, are not listed.

    Args:
        scene: the gearbox.

    Returns:
        The names; none without its section `durability`.
    """
    check_scene(scene)
    if scene.durability is None:
        return ()
    roots = scene.gearset.helix_angle == 0.0
    planets = [f"planet_{k}" for k in range(1, scene.gearset.planets + 1)]
    names = ["sun_flank_drive", "sun_flank_coast", *["sun_root"] * roots]
    for planet in planets:
        names += [f"{planet}_flank_sun", f"{planet}_flank_ring", *[f"{planet}_root"] * roots]
    names += ["ring_flank_drive", "ring_flank_coast"]
    if scene.durability.bearings.planet is not None:
        names += [f"{planet}_bearing" for planet in planets]
    return tuple(names)
