"""Fields that have no effect in a scene."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from .._core import FIELDS_OF_TRACTION
from .lubrication import Lubrication
from .scene import Scene
from .sensors.unused import unused_of_sensor

_OF_BOUNDARY = {"load_sharing": "boundary_coefficient", "greenwood_tripp": "shear_stress"}
"""Field that a law of boundary friction uses, but film and load sharing do not."""


def not_in_use(scene: Scene, name: str) -> str | None:
    """Why a field has no effect.

    Args:
        scene: the scene.
        name: dotted name of the field.

    Returns:
        The reason and the setting that gives the field an effect; None if the field has one.
    """
    plain = name.removeprefix("operating_point.")
    if plain == "lambda_ratio" and scene.lubrication.lambda_ratio != "prescribed":
        return (
            "the scene computes it (lubrication.lambda_ratio = computed); "
            "set lubrication.lambda_ratio = prescribed to prescribe it"
        )
    section, _, field = plain.partition(".")
    if section == "sensors":
        number, _, own = field.partition(".")
        there = number.isdecimal() and int(number) < len(scene.sensors)
        return unused_of_sensor(scene.sensors[int(number)], own) if there else None
    if section == "lubrication" and (reason := _not_in_friction(scene.lubrication, field)):
        return reason
    if plain == "lubrication.viscosity_index" and scene.lubrication.iso_vg is None:
        return "lubrication.iso_vg is not given; set it to a grade, such as 220"
    if plain == "mesh.ramp" and scene.mesh.entry == "loaded":
        return "loaded teeth enter without it (mesh.entry = loaded); set mesh.entry = ramp"
    if plain == "oil_temperature" and scene.thermal is not None:
        return "it is a state of the scene (thermal); set thermal.start to start elsewhere"
    if plain == "ambient_temperature" and scene.thermal is None:
        return "the scene has no section thermal"
    if plain == "second_input_speed" and scene.drive.second_input is None:
        return "the scene has no second input"
    beyond_plane = plain.endswith((".axial", ".tilting", ".axial_damping", ".tilting_damping"))
    if plain.startswith("supports.") and beyond_plane and not scene.tilting_axes:
        return "axes do not tilt; set dynamics = spatial, or see the command modal"
    if plain.startswith(("supports.", "errors.pin_stiffness")) and not scene.moving_axes:
        return (
            "runs hold the axes; set dynamics = planar to move them, or see the commands "
            "load-sharing and modal"
        )
    held = scene.gearset.held
    if plain.startswith((f"losses.{held}_bearing", f"losses.{held}_drag")):
        return f"this member is fixed (gearset.held = {held})"
    return None


def _not_in_friction(lubrication: Lubrication, field: str) -> str | None:
    """Why the laws of friction do not use a field of `lubrication`; None if they do."""
    field, traction, boundary = field.partition(".")[0], lubrication.traction, lubrication.boundary
    added = not lubrication.includes_boundary_friction
    if field in FIELDS_OF_TRACTION[traction] or (added and field == _OF_BOUNDARY[boundary]):
        return None
    if field == "boundary" or field in _OF_BOUNDARY.values():
        if not added:
            return f"lubrication.traction = {traction} includes boundary friction"
        using = next((law for law, used in _OF_BOUNDARY.items() if used == field), boundary)
        if using != boundary:
            return (
                f"lubrication.boundary = {boundary} does not use it; "
                f"set lubrication.boundary = {using} to use it"
            )
        return None
    using_it = [law for law, fields in FIELDS_OF_TRACTION.items() if field in fields]
    if not using_it:
        return None
    return (
        f"lubrication.traction = {traction}; set lubrication.traction = "
        f"{' or '.join(using_it)} to use it"
    )


def without_effect(scene: Scene, names: Iterable[str]) -> Iterator[str]:
    """A warning for each of the fields `names` that has no effect in `scene`."""
    for name in names:
        if reason := not_in_use(scene, name):
            yield f"{name}: has no effect: {reason}"


def without_effect_in_all(scenes: Sequence[Scene], names: Iterable[str]) -> Iterator[str]:
    """Remarks on fields that have no effect in any of several scenes.

    Args:
        scenes: the scenes; none are no reason for a remark.
        names: dotted names of the fields.
    """
    for name in names if scenes else ():
        if all(not_in_use(scene, name) for scene in scenes):
            yield from without_effect(scenes[0], [name])
