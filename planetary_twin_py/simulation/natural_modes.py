"""Natural modes of a scene with any dynamics."""

from __future__ import annotations

from ..modal import natural
from ..modal.modes import NaturalModes
from ..run.dynamics_choice import AUTO
from ..scene import Scene
from ..scene.given import check_scene
from .choose_dynamics import choose_dynamics


def natural_modes(
    scene: Scene,
    model: str | None = None,
    stiffness: str = "single",
    input_speed: float | None = None,
) -> NaturalModes:
    """Natural modes of a scene without damping, see `modal.natural.natural_modes`.

    Args:
        scene: the scene; with dynamics: auto, `choose_dynamics` selects the model.
        model: as there.
        stiffness: as there.
        input_speed: as there [rad/s].

    Returns:
        As there.

    Raises:
        ValueError: as there; or the scene cannot run with any dynamics.
    """
    check_scene(scene)
    return natural.natural_modes(chosen(scene, model), model, stiffness, input_speed)


def chosen(scene: Scene, model: str | None = None) -> Scene:
    """The scene with dynamics of which modes have a model.

    Args:
        scene: the scene.
        model: model of the modes; None: that of the dynamics of the scene.

    Returns:
        The scene, in which auto is replaced where no model is given.

    Raises:
        ValueError: the scene cannot run with any dynamics.
    """
    return choose_dynamics(scene).scene if scene.dynamics == AUTO and model is None else scene
