"""What to know about the natural modes of a scene: loads and stiffnesses that they depend on."""

from __future__ import annotations

from collections.abc import Collection, Iterator

from ..model.gearbox import Gearbox
from ..scene import Scene
from ..scene.support_rules import missing_stiffnesses
from ..statics.small_motion import depends_on_load
from ..units.engineering import figure
from .natural import MOVING_AXES, carrying_planets
from .whirl import whirl_warning


def modal_remarks(scene: Scene, model: str, input_speed: float | None) -> Iterator[str]:
    """Sentences on what the natural modes of a scene depend on, or lack.

    Args:
        scene: the scene.
        model: see `natural_modes`.
        input_speed: speed of the first motor [rad/s]; None or 0 if nothing turns.
    """
    yield from _bearings_of_load(scene, model)
    yield from _bearings_without_stiffness(scene, model)
    yield from _planets_without_load(scene, model)
    if input_speed is not None:
        point = scene.operating_point.model_copy(update={"input_speed": input_speed})
        if line := whirl_warning(Gearbox(scene), point):
            yield line


def _bearings_of_load(scene: Scene, model: str) -> Iterator[str]:
    """Bearings that are linear about their static load."""
    supports = scene.supports
    if supports is None or model not in MOVING_AXES:
        return
    bodies = ("sun", "ring", "carrier", "planet")
    found = [body for body in bodies if depends_on_load(getattr(supports, body))]
    if found:
        yield (
            f"{', '.join(f'supports.{body}' for body in found)}: a bearing with clearance or "
            "rolling elements is linear about its mean static load at input_torque = "
            f"{_torque(scene)}, and has no stiffness without load: modes are those of vibration "
            "that is small compared with this load"
        )


def _bearings_without_stiffness(scene: Scene, model: str) -> Iterator[str]:
    """Axial and tilting stiffnesses that the scene lacks."""
    if scene.supports is None or model != "spatial":
        return
    if missing := [*missing_stiffnesses(scene.supports)]:
        yield (
            f"{', '.join(missing)}: missing, so without stiffness: some modes are rigid or lower "
            "for that reason alone; dynamics = spatial requires a stiffness of each, 0 where a "
            "body floats"
        )


def _planets_without_load(scene: Scene, model: str) -> Iterator[str]:
    """Planets whose meshes are open in static equilibrium."""
    shares = dict(enumerate(carrying_planets(scene, model), 1))
    never = [n for n, share in shares.items() if share == 0.0]
    at_times = {n: share for n, share in shares.items() if 0.0 < share < 1.0}
    parts = []
    if never:
        parts.append(f"{_planets(never)} without load, so without stiffness")
    if at_times:
        shown = ", ".join(f"{share:.2g}" for share in at_times.values())
        parts.append(f"{_planets(at_times)} with load, so stiffness, for {shown} of the time")
    if parts:
        yield (
            f"in static equilibrium at input_torque = {_torque(scene)} there are meshes of "
            f"{', and of '.join(parts)} (see load-sharing): modes are those of vibration that "
            "neither opens nor closes meshes"
        )


def _planets(numbers: Collection[int]) -> str:
    return f"planet{'s' * (len(numbers) > 1)} {', '.join(map(str, numbers))}"


def _torque(scene: Scene) -> str:
    return figure(scene.operating_point.input_torque, "N m")
