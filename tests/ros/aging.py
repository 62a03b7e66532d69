"""A scene that ages, as a file, and the damage in a file of it."""

from pathlib import Path

import yaml
from planetary_twin_msgs.msg import DamageState

import planetary_twin_py as pt
from planetary_twin_py.durability.damage_state import DamageState as State
from planetary_twin_py.durability.parts import part_names
from planetary_twin_py.durability.state_file import read_state

SCENE = pt.load_scene("paper").replace(
    durability={
        "material": {"sun": "case_hardened", "planet": "case_hardened", "ring": "case_hardened"},
        "bearings": {"planet": {"rating": 20e3, "kind": "roller"}},
    }
)
PARTS = part_names(SCENE)


def scene_file(place: Path, name: str = "aging.yaml") -> Path:
    """The scene in a file of `place`."""
    path = place / name
    path.write_text(yaml.safe_dump(SCENE.model_dump(mode="json"), sort_keys=False))
    return path


def saved(path: Path) -> State:
    """The damage in a file of the scene."""
    return read_state(path, SCENE, PARTS)


def sums_of(message: DamageState) -> dict[str, float]:
    """Miner sums of a message by part."""
    return dict(zip(message.parts, message.damage, strict=True))
