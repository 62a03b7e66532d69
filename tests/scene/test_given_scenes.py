"""What is given in place of a scene is refused in one line, which says how to make one."""

import inspect
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import planetary_twin_py as pt

RUN = pt.simulate(pt.load_scene("paper"), 1e-4)
DUTY = pt.Duty(np.ones(1), {"input_torque": np.ones(1), "input_speed": np.ones(1)})
CALLS: dict[str, Callable[[Any], object]] = {
    "simulate": lambda scene: pt.simulate(scene, 0.1),
    "Twin": pt.Twin,
    "choose_dynamics": pt.choose_dynamics,
    "check_exchange": lambda scene: pt.check_exchange(scene, pt.load_scene("paper"), 1e-3),
    "duty_life": lambda scene: pt.duty_life(scene, DUTY),
    "export_fmu": lambda scene: pt.export_fmu(scene, "never.fmu"),
    "load_sharing": pt.load_sharing,
    "natural_modes": pt.natural_modes,
    "fault_orders": pt.fault_orders,
    "measure_vibration": lambda scene: pt.measure_vibration(scene, RUN),
    "wear": lambda scene: pt.wear(scene, 1.0),
    "Follower": pt.Follower,
    "part_names": pt.part_names,
    "Fleet": lambda scene: pt.Fleet(scene, 2),
}
RECORDS = {"Outcome", "DynamicsChoice", "Wear"}  # results that contain a scene


@pytest.mark.parametrize("name", CALLS)
def test_a_name_for_a_scene_is_refused_with_the_call_to_load(name: str) -> None:
    for given in ("paper", Path("paper")):
        with pytest.raises(pt.SceneError) as refusal:
            CALLS[name](given)
        assert str(refusal.value) == (
            f'scene = {given!r}: must be a Scene; load_scene("paper") gives it'
        )


@pytest.mark.parametrize(
    "several", [pt.Twins, lambda scenes: pt.simulate_many(scenes, 0.1)], ids=["Twins", "many"]
)
def test_of_several_scenes_the_one_that_is_none_is_named(several: Callable[[Any], Any]) -> None:
    paper = pt.load_scene("paper")
    with pytest.raises(ValueError, match=r"^scenes\[1\] = 'compact_actuator': must be a Scene"):
        list(several([paper, "compact_actuator"]))
    for given, shown in (("paper", "'paper'"), (paper, "a Scene"), (7, "7")):
        with pytest.raises(ValueError, match=f"^scenes = {shown}: must be several"):
            several(given)


def test_every_public_call_that_takes_a_scene_is_tried() -> None:
    def annotated(public: Any) -> set[Any]:
        function = public.__init__ if inspect.isclass(public) else public
        given = dict(getattr(function, "__annotations__", {}))
        given.pop("return", None)
        return set(given.values())

    taking = {name for name in pt.__all__ if annotated(getattr(pt, name)) & {"Scene", pt.Scene}}
    assert taking - RECORDS == set(CALLS)
