"""What a run follows from: its scene, and what computed it.

With what was changed while it ran, which its messages tell, a run can be simulated again. On the
same kernels and the same kind of machine it is the same to the last bit.
"""

from __future__ import annotations

import hashlib
from dataclasses import asdict, dataclass
from importlib.metadata import PackageNotFoundError, version
from typing import Any

import yaml

from ...scene import Scene, parse_scene
from ...scene.yaml_text import read_yaml
from ..container.records import RecordingError

SOFTWARE = ("planetary_twin_py", "numba", "llvmlite", "numpy", "scipy")


@dataclass(frozen=True)
class Makers:
    """What computed a run."""

    kernels: str
    """Digest of the source of the compiled kernels."""
    machine: str
    """Processor that they are compiled for, and a digest of its features."""
    software: dict[str, str]
    """Versions of the packages that the numbers come from."""


@dataclass(frozen=True)
class Measured:
    """Stands for the makers of a run that nothing has computed: it was measured."""

    measured: str
    """Name of the table that it comes from."""


@dataclass(frozen=True)
class Origin:
    """A scene, when it began to run, and on what."""

    scene: Scene
    begins: int
    """ROS time of simulated time zero [ns]."""
    makers: Makers | Measured

    def text(self) -> str:
        """As it travels in a recording, in YAML."""
        scene = self.scene.model_dump(mode="json")
        content = {"begins": self.begins, **asdict(self.makers), "scene": scene}
        return yaml.safe_dump(content, sort_keys=False)


def makers_here() -> Makers:
    """What computes on this machine."""
    from llvmlite import binding

    from ..._compile import cache_folder

    features = binding.get_host_cpu_features().flatten()
    digest = hashlib.sha256(features.encode()).hexdigest()[:16]
    found = {}
    for package in SOFTWARE:
        try:
            found[package] = version(package)
        except PackageNotFoundError:
            continue
    return Makers(cache_folder().name, f"{binding.get_host_cpu_name()} {digest}", found)


def read_origin(text: str) -> Origin:
    """What `Origin.text` has written.

    Raises:
        RecordingError: the text is something else.
    """
    try:
        content = _mapping(text)
        scene = parse_scene(_scene(content))
        begins = int(content["begins"])
        makers = _read_makers(content)
    except KeyError as reason:
        raise RecordingError(f"origin of the run: {reason}: missing") from None
    except (TypeError, ValueError, OverflowError) as reason:
        raise RecordingError(f"origin of the run: cannot be read: {reason}") from None
    return Origin(scene, begins, makers)


def scene_of_origin(text: str) -> str:
    """YAML of the scene that `Origin.text` holds.

    Raises:
        RecordingError: the text is something else.
    """
    try:
        return _scene(_mapping(text))
    except (KeyError, ValueError) as reason:
        raise RecordingError(f"origin of the run: cannot be read: {reason}") from None


def _mapping(text: str) -> dict[str, Any]:
    content = read_yaml(text, "text")
    if not isinstance(content, dict):
        raise ValueError("must be a mapping")
    return content


def _scene(content: dict[str, Any]) -> str:
    return yaml.safe_dump(content["scene"], sort_keys=False)


def _read_makers(content: dict[str, Any]) -> Makers | Measured:
    if "measured" in content:
        return Measured(content["measured"])
    software = content["software"]
    if not isinstance(software, dict):
        raise ValueError("software: must be a mapping")
    return Makers(content["kernels"], content["machine"], software)
