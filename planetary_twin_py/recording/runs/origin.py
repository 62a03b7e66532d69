"""Origin of a run: its scene, and the software and machine that computed it.

With the parameter changes in its messages, a run can be simulated again. With the same core on the
same type of machine the result is identical bit for bit.
"""

from __future__ import annotations

from dataclasses import asdict, dataclass
from importlib.metadata import PackageNotFoundError, version
from platform import libc_ver
from typing import Any

import yaml

from ...durability.damage_state import DamageState
from ...durability.parts import part_names
from ...durability.run_damage import RunDamage
from ...durability.state_text import parse_state, state_text
from ...scene import Scene, parse_scene
from ...scene.yaml_text import read_yaml
from ..container.records import RecordingError

SOFTWARE = ("planetary_twin_py", "numpy", "scipy")


@dataclass(frozen=True)
class Makers:
    """Software and machine that computed a run."""

    kernels: str
    """Digest of the sources of the compiled core."""
    machine: str
    """Instructions that the core uses, and the C library."""
    software: dict[str, str]
    """Versions of the packages that affect the numbers."""


@dataclass(frozen=True)
class Measured:
    """In place of `Makers` for a run that was measured, not computed."""

    measured: str
    """Name of the table with the measurements."""


@dataclass(frozen=True)
class Origin:
    """A scene, the start time of its run, and what computed it."""

    scene: Scene
    begins: int
    """ROS time of simulated time zero [ns]."""
    makers: Makers | Measured
    damage: DamageState | None = None
    """Damage of its parts at the start; None if there is none yet."""

    def text(self) -> str:
        """YAML text for a recording."""
        scene = self.scene.model_dump(mode="json")
        content: dict[str, Any] = {"begins": self.begins, **asdict(self.makers), "scene": scene}
        if self.damage is not None:
            content["damage"] = state_text(self.damage, self.scene)
        return yaml.safe_dump(content, sort_keys=False)


def damage_at(origin: Origin) -> RunDamage | None:
    """The damage with which a run starts; None if its scene has no section `durability`."""
    parts = part_names(origin.scene)
    if not parts:
        return None
    return RunDamage(DamageState(parts) if origin.damage is None else origin.damage)


def makers_here() -> Makers:
    """Software and machine of this process."""
    from ..._core import LEVEL, SOURCES
    from ..._core.levels import architecture

    versions = {}
    for package in SOFTWARE:
        try:
            versions[package] = version(package)
        except PackageNotFoundError:
            continue
    return Makers(SOURCES, f"{architecture(LEVEL)} {' '.join(libc_ver())}", versions)


def read_origin(text: str) -> Origin:
    """Parse the text of `Origin.text`.

    Raises:
        RecordingError: the text is invalid.
    """
    content = _content(text)
    try:
        makers = (
            Measured(content["measured"])
            if "measured" in content
            else Makers(content["kernels"], content["machine"], dict(content["software"]))
        )
        scene = parse_scene(_scene(content))
        damage = None
        if "damage" in content:
            damage = parse_state(str(content["damage"]), scene, part_names(scene))
        return Origin(scene, int(content["begins"]), makers, damage)
    except KeyError as reason:
        raise RecordingError(f"origin of the run: {reason}: missing") from None
    except (TypeError, ValueError, OverflowError) as reason:
        raise RecordingError(f"origin of the run: cannot be read: {reason}") from None


def scene_of_origin(text: str) -> str:
    """YAML of the scene in the text of `Origin.text`.

    Raises:
        RecordingError: the text is invalid.
    """
    return _scene(_content(text))


def _content(text: str) -> dict[str, Any]:
    try:
        content = read_yaml(text, "text")
    except ValueError as reason:
        raise RecordingError(f"origin of the run: cannot be read: {reason}") from None
    if not isinstance(content, dict) or "scene" not in content:
        raise RecordingError("origin of the run: cannot be read: must be a mapping with a scene")
    return content


def _scene(content: dict[str, Any]) -> str:
    return yaml.safe_dump(content["scene"], sort_keys=False)
