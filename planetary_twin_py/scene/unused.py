"""Fields that a scene has but does not use."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from .scene import Scene

_SCHLENK_LEAVES_OUT = (
    "lubrication.boundary",
    "lubrication.boundary_coefficient",
    "lubrication.limiting_stress",
    "lubrication.shear_stress",
)


def not_in_use(scene: Scene, name: str) -> str | None:
    """Why the field `name` has no effect in `scene`, and what gives it one; None if it has."""
    plain = name.removeprefix("operating_point.")
    if plain == "lambda_ratio" and scene.lubrication.lambda_ratio != "prescribed":
        return (
            "the scene computes it (lubrication.lambda_ratio = computed); "
            "set lubrication.lambda_ratio = prescribed to give it"
        )
    if scene.lubrication.traction == "schlenk" and plain in _SCHLENK_LEAVES_OUT:
        return "lubrication.traction = schlenk has boundary friction in it, whatever the film"
    if plain == "second_input_speed" and scene.drive.second_input is None:
        return "the scene has no second input"
    held = scene.gearset.held
    if plain.startswith((f"losses.{held}_bearing", f"losses.{held}_drag")):
        return f"the gearset holds it (gearset.held = {held})"
    return None


def without_effect(scene: Scene, names: Iterable[str]) -> Iterator[str]:
    """A line for each of `names` that is given but not in use."""
    for name in names:
        if reason := not_in_use(scene, name):
            yield f"{name}: has no effect: {reason}"
