"""Fields that have no effect in a scene."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from .scene import Scene

_UNUSED_WITHOUT_BOUNDARY = (
    "lubrication.boundary",
    "lubrication.boundary_coefficient",
    "lubrication.limiting_stress",
    "lubrication.shear_stress",
)
_WITH_BOUNDARY = ("eyring", "evans_johnson", "printed")  # viscous laws, boundary friction is added


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
    traction = scene.lubrication.traction
    if scene.lubrication.includes_boundary_friction and plain in _UNUSED_WITHOUT_BOUNDARY:
        return f"lubrication.traction = {traction} includes boundary friction"
    boundary = scene.lubrication.boundary
    if (
        plain == "lubrication.boundary_coefficient"
        and traction in _WITH_BOUNDARY
        and boundary != "load_sharing"
    ):
        return (
            f"lubrication.boundary = {boundary} does not use it; "
            "set lubrication.boundary = load_sharing to use it"
        )
    if plain == "lubrication.viscosity_index" and scene.lubrication.iso_vg is None:
        return "lubrication.iso_vg is not given; set it to a grade, such as 220"
    if traction != "table" and plain.startswith("lubrication.friction_table"):
        return f"lubrication.traction = {traction}; set lubrication.traction = table to use it"
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


def without_effect(scene: Scene, names: Iterable[str]) -> Iterator[str]:
    """A warning for each of the fields `names` that has no effect in `scene`."""
    for name in names:
        if reason := not_in_use(scene, name):
            yield f"{name}: has no effect: {reason}"
