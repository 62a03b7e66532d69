"""Loads scenes: packaged ones, or YAML files that may start from a packaged one."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from importlib import resources
from pathlib import Path
from typing import Any

from ..text.escaping import one_line
from .names import did_you_mean
from .oil_grade import without_other_oil
from .paths import NoSuchPath, with_value
from .quantity import SceneError
from .scene import Scene, path_of, validated
from .yaml_file import read_text
from .yaml_text import read_yaml

_FORMS = (  # of a gear set: each is given in one of two
    (("equivalent_mass",), ("inertia",)),
    (("module", "pressure_angle"), ("normal_module", "normal_pressure_angle")),
)


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
    return load_changed(name_or_path, {})


def load_changed(name_or_path: str | Path, changes: Mapping[str, Any]) -> Scene:
    """Load a scene and change it; changes may repair what is invalid in the file.

    Args:
        name_or_path: name of a packaged scene, or path of a YAML file.
        changes: values by name, see `Scene.replace`.

    Raises:
        SceneError: the scene does not exist, or a field is invalid.
    """
    if str(name_or_path) in packaged_scenes():
        return parse_scene(_packaged(str(name_or_path))).replace(**changes)
    path = Path(name_or_path)
    text = _read(path)
    try:
        data = _fields(text, (path,))
        scene = _valid(data)
        if scene is None and changes:
            return validated(_changed(data, changes))
        scene = scene or validated(data)
    except SceneError as error:
        raise SceneError(f"{name_or_path}: {error}") from None
    return scene.replace(**changes)


def _valid(data: dict[str, Any]) -> Scene | None:
    try:
        return validated(data)
    except SceneError:
        return None


def _changed(data: dict[str, Any], changes: Mapping[str, Any]) -> dict[str, Any]:
    """Fields of a file with changes; as they are, if the file lacks what is to be changed."""
    try:
        for name, value in changes.items():
            data = with_value(data, [Scene], path_of(name), value)
    except NoSuchPath:  # of a name, or an entry of a list, which no valid scene would show either
        raise SceneError(f"{name}: is not a field of the file, which is invalid") from None
    return data


def _packaged(name: str) -> str:
    return (resources.files(__package__) / "packaged" / f"{name}.yaml").read_text()


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
            differences from that scene. In a file, ``base`` may be the path of another file, from
            the folder of the first one.

    Returns:
        The scene.

    Raises:
        SceneError: the text is not a YAML mapping, a key occurs twice, or a field is invalid.
    """
    return validated(_fields(text, ()))


def _fields(text: str, files: tuple[Path, ...]) -> dict[str, Any]:
    """Values of the fields of a scene and its base; `files` are those that lead here."""
    data = read_yaml(text)
    if not isinstance(data, dict):
        raise SceneError("scene is not a YAML mapping")
    if "base" not in data:
        return data
    base = _base(data.pop("base"), files)
    return _overlaid(_without_other_forms(base, data), data)


def _base(given: Any, files: tuple[Path, ...]) -> dict[str, Any]:
    """Values of the fields of a base: a packaged scene, or a file beside the last of `files`."""
    if given in packaged_scenes():
        return load_scene(given).model_dump()
    name = one_line(str(given), 60)
    if files and name.endswith((".yaml", ".yml")):
        path = files[-1].parent / str(given)
        if any(path.resolve() == file.resolve() for file in files):
            raise SceneError(f"base = {name!r}: leads back to itself")
        try:
            return _fields(read_text(path), (*files, path))
        except (SceneError, OSError) as error:
            reason = error.strerror if isinstance(error, OSError) else error
            raise SceneError(f"base = {name!r}: {reason}") from None
    raise SceneError(
        f"base = {name!r}: must be a file NAME.yaml beside that of the scene, or one of "
        f"{', '.join(packaged_scenes())}{did_you_mean(name, packaged_scenes())}"
    )


def _without_other_forms(base: dict[str, Any], changes: dict[str, Any]) -> dict[str, Any]:
    """Return `base` without what `changes` gives in another form: an oil, inertias, a plane."""
    oil, gears = changes.get("lubrication"), changes.get("gearset")
    if isinstance(oil, dict):
        base = base | {"lubrication": without_other_oil(base.get("lubrication") or {}, oil)}
    if isinstance(gears, dict):
        replaced = dict.fromkeys(_replaced(gears.keys()))
        base = base | {"gearset": (base.get("gearset") or {}) | replaced}
    return base


def _replaced(given: Collection[str]) -> Iterator[str]:
    """Fields of the other form where only one form is `given`."""
    for forms in _FORMS:
        for form, other in (forms, forms[::-1]):
            if any(name in given for name in form) and not any(name in given for name in other):
                yield from other


def _overlaid(base: Any, changes: Any) -> Any:
    """`base` with `changes`: mappings are merged, other values are replaced."""
    if not isinstance(base, dict) or not isinstance(changes, dict):
        return changes
    return base | {name: _overlaid(base.get(name), value) for name, value in changes.items()}
