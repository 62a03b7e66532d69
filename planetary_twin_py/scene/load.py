"""Loads scenes: packaged ones, or YAML files that may start from a packaged one."""

from __future__ import annotations

from importlib import resources
from pathlib import Path
from typing import Any

from ..printable import one_line
from .names import did_you_mean
from .oil_grade import without_other_oil
from .quantity import SceneError
from .scene import Scene, validated
from .yaml_file import read_text
from .yaml_text import read_yaml


def packaged_scenes() -> tuple[str, ...]:
    """Names of the packaged scenes.

    Returns:
        The names, sorted.
    """
    folder = resources.files(__package__) / "packaged"
    return tuple(sorted(Path(f.name).stem for f in folder.iterdir() if f.name.endswith(".yaml")))


def load_scene(name_or_path: str | Path) -> Scene:
    """Load a scene.

    Args:
        name_or_path: name of a packaged scene, or path of a YAML file.

    Returns:
        The scene.

    Raises:
        SceneError: the scene does not exist, or a field is invalid; the message names the file.
    """
    if str(name_or_path) in packaged_scenes():
        file = resources.files(__package__) / "packaged" / f"{name_or_path}.yaml"
        return parse_scene(file.read_text())
    text = _read(Path(name_or_path))
    try:
        return parse_scene(text)
    except SceneError as error:
        raise SceneError(f"{name_or_path}: {error}") from None


def _read(path: Path) -> str:
    """Text of a regular file, up to the longest scene."""
    try:
        return read_text(path)
    except SceneError as error:
        raise SceneError(f"scene = {str(path)!r}: {error}") from None
    except (OSError, ValueError) as error:
        reason = error.strerror if isinstance(error, OSError) else error
        raise SceneError(
            f"scene = {str(path)!r}: neither a readable file ({reason}) nor "
            f"one of {', '.join(packaged_scenes())}"
            f"{did_you_mean(str(path), packaged_scenes())}"
        ) from None


def parse_scene(text: str) -> Scene:
    """Parse a scene.

    Args:
        text: YAML. With the key ``base``, the name of a packaged scene, it contains only the
            differences from that scene.

    Returns:
        The scene.

    Raises:
        SceneError: the text is not a YAML mapping, a key occurs twice, or a field is invalid.
    """
    data = read_yaml(text)
    if not isinstance(data, dict):
        raise SceneError("scene is not a YAML mapping")
    if "base" in data:
        base = data.pop("base")
        if base not in packaged_scenes():
            name = one_line(str(base), 60)
            raise SceneError(
                f"base = {name!r}: must be one of {', '.join(packaged_scenes())}"
                f"{did_you_mean(name, packaged_scenes())}{_no_file(name)}"
            )
        data = _overlaid(_without_other_forms(load_scene(base).model_dump(), data), data)
    return validated(data)


def _no_file(name: str) -> str:
    """Part of a message if a base is the name of a file: a scene is one file."""
    if "/" not in name and not name.endswith((".yaml", ".yml")):
        return ""
    return "; a file cannot be a base: copy its fields, or change it with --set NAME=VALUE"


def _without_other_forms(base: dict[str, Any], changes: dict[str, Any]) -> dict[str, Any]:
    """Return `base` without moments of inertia and an oil that `changes` gives in another form."""
    if isinstance(changes.get("lubrication"), dict):
        oil = without_other_oil(base["lubrication"], changes["lubrication"])
        base = base | {"lubrication": oil}
    given = changes.get("gearset")
    forms = {"equivalent_mass": "inertia", "inertia": "equivalent_mass"}
    if not isinstance(given, dict) or len(forms.keys() & given.keys()) != 1:
        return base
    (form,) = forms.keys() & given.keys()
    return base | {"gearset": base["gearset"] | {forms[form]: None}}


def _overlaid(base: Any, changes: Any) -> Any:
    """`base` with `changes`: mappings are merged, other values are replaced."""
    if not isinstance(base, dict) or not isinstance(changes, dict):
        return changes
    return base | {name: _overlaid(base.get(name), value) for name, value in changes.items()}
