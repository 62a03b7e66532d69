"""Parts of a gearbox that collect damage."""

from __future__ import annotations

from collections.abc import Mapping

from ..scene import Scene
from ..scene.given import check_scene

MEMBERS = "sun", "ring", "carrier"  # in the order of their bearings
SHAFTS = ("input", "output")  # in the order of the machines


def has_root(scene: Scene, gear: str) -> bool:
    """Whether the root of a gear is counted.

    Args:
        scene: the gearbox, with its section `durability`.
        gear: its name: sun, planet or ring.
    """
    assert scene.durability is not None
    return scene.gearset.helix_angle == 0.0 and (gear != "ring" or scene.durability.ring_root)


def part_names(scene: Scene) -> tuple[str, ...]:
    """Names of the parts that collect damage in a scene.

    Teeth first, from sun to ring: their flanks (contact) and roots (bending), then bearings of
    planets and of members, and shafts. `drive` is the flank that carries where mesh forces are
    positive; `planet_k_flank_sun` is the flank of planet k that then meets the sun, and meets the
    ring where they are negative. Roots are those of spur teeth, of the ring if the scene asks for
    it: others, and bearings and shafts without a rating, are not listed.

    Args:
        scene: the gearbox.

    Returns:
        The names; none without its section `durability`.
    """
    check_scene(scene)
    if scene.durability is None:
        return ()
    roots = has_root(scene, "sun")
    planets = [f"planet_{k}" for k in range(1, scene.gearset.planets + 1)]
    names = ["sun_flank_drive", "sun_flank_coast", *["sun_root"] * roots]
    for planet in planets:
        names += [f"{planet}_flank_sun", f"{planet}_flank_ring", *[f"{planet}_root"] * roots]
    names += ["ring_flank_drive", "ring_flank_coast", *["ring_root"] * has_root(scene, "ring")]
    if scene.durability.bearings.planet is not None:
        names += [f"{planet}_bearing" for planet in planets]
    rated = scene.durability.bearings
    names += [f"{member}_bearing" for member in MEMBERS if getattr(rated, member) is not None]
    shafts = scene.durability.shafts
    names += [f"{side}_shaft" for side in SHAFTS if getattr(shafts, side) is not None]
    return tuple(names)


def parts_of(name: str, parts: tuple[str, ...]) -> tuple[str, ...]:
    """Parts that a name stands for.

    Args:
        name: a part, such as `planet_2_bearing`, or a gear, such as `planet_2` or `sun`, whose
            flanks and root it is.
        parts: names of all parts.

    Raises:
        ValueError: there is no such part.
    """
    if name in parts:
        return (name,)
    found = tuple(part for part in parts if part.startswith((f"{name}_flank", f"{name}_root")))
    if not found:
        gears = dict.fromkeys(
            part.partition("_flank")[0].partition("_root")[0]
            for part in parts
            if not part.endswith(("_bearing", "_shaft"))
        )
        raise ValueError(f"part = {name!r}: must be one of {', '.join((*gears, *parts))}")
    return found


def teeth_of(part: str, teeth: Mapping[str, int]) -> int:
    """Teeth of a part; 1 for a bearing or a shaft.

    Args:
        part: its name.
        teeth: number of teeth by the name of the gear.
    """
    if part.endswith(("_bearing", "_shaft")):
        return 1
    return next(count for gear, count in teeth.items() if part.startswith(f"{gear}_"))


def parts_of_mesh(mesh: int, planets: int, side: int) -> tuple[tuple[str, str], tuple[str, str]]:
    """Names of the flank and the root of both gears of a mesh, whether they are counted or not.

    Args:
        mesh: its number, sun meshes first.
        planets: number of planets.
        side: 0: drive flanks, 1: coast flanks.
    """
    kind, k = divmod(mesh, planets)
    member, met = ("sun", "ring")[kind], ("sun", "ring")[kind ^ side]
    ours = f"{member}_flank_{('drive', 'coast')[side]}", f"{member}_root"
    planet = f"planet_{k + 1}_flank_{met}", f"planet_{k + 1}_root"
    return (ours, planet) if kind == 0 else (planet, ours)
