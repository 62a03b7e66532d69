"""`--set NAME=VALUE`: changes to a scene on the command line."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

from .messages import note

if TYPE_CHECKING:
    from ..scene import Scene

_COLLECTIONS = ("[", "{")
_NOTHING = "null"  # removes an optional value or section, as in a scene file


def settings(given: Sequence[str], option: str = "--set") -> dict[str, Any]:
    """Parse settings for `Scene.replace`.

    Args:
        given: texts NAME=VALUE. Lists and sections are written as in a scene file:
            gearset.planet_angles=[0 deg, 180 deg], losses.planet_bearing={mean_diameter: 10 mm}.
            null removes an optional value or section.
        option: name of the option that gives them, for error messages.

    Returns:
        Values (texts, lists, mappings and None) by name.

    Raises:
        ValueError: a text is not NAME=VALUE, or a name occurs twice.
    """
    from ..scene.yaml_text import read_yaml

    values: dict[str, Any] = {}
    for setting in given:
        name, equals, value = setting.partition("=")
        if not (name and equals):
            raise ValueError(f"{option} {setting!r}: must be NAME=VALUE")
        if name in values:
            raise ValueError(f"{option} {name}: given twice, as {values[name]} and as {value}")
        values[name] = None if value.strip() == _NOTHING else value
        if value.lstrip().startswith(_COLLECTIONS):
            values[name] = read_yaml(value, f"{option} {name}")
    return values


def numbers(given: Sequence[str], option: str, kind: str = "a number") -> dict[str, float]:
    """Parse settings whose values are numbers.

    Args:
        given: texts NAME=VALUE.
        option: name of the option that gives them, for error messages.
        kind: what a value must be, for error messages.

    Raises:
        ValueError: a text is not NAME=VALUE, a name occurs twice, or a value is not a number.
    """
    found = {}
    for name, value in settings(given, option).items():
        try:
            found[name] = float(value)
        except (TypeError, ValueError):  # of a list or null
            raise ValueError(f"{option} {name} = {value!r}: must be {kind}") from None
    return found


def changed_scene(name: str, changes: Mapping[str, Any]) -> Scene:
    """Load a scene with changes, and print in which unit each number without unit was read.

    Args:
        name: packaged scene, or path of a YAML file.
        changes: values by field name, from `settings`.

    Raises:
        SceneError: the scene does not exist, or a field is invalid.
    """
    from ..scene.load import load_changed

    scene = load_changed(name, changes)
    say_units(scene, changes)
    return scene


def scene_with(name: str, given: Sequence[str] | None) -> Scene:
    """Load a scene with the changes of `--set`, see `changed_scene`.

    Args:
        name: packaged scene, or path of a YAML file.
        given: texts NAME=VALUE.

    Raises:
        ValueError: the scene does not exist, a text is not NAME=VALUE, or a field is invalid.
    """
    return changed_scene(name, settings(given or []))


def say_units(scene: Scene, changes: Mapping[str, Any]) -> None:
    """Print in which unit each number without unit was read.

    Args:
        scene: has all fields of `changes`.
        changes: values by dotted name, as typed.
    """
    from ..scene.paths import leaves
    from ..scene.quantity import unit_of
    from ..studies.axes import look_up
    from ..units.conversion import is_number

    for name, value in leaves(changes):
        if is_number(str(value)) and (unit := unit_of(look_up(scene, name)[0])):
            note(read_as_si(name, float(value), unit))


def read_as_si(name: str, value: float, unit: str) -> str:
    """Say how a number without a unit was read.

    Args:
        name: name of the quantity.
        value: the number, in SI.
        unit: SI unit.
    """
    return f"{in_words(name, value, unit)}: no unit is given, so this is SI"


def in_words(name: str, value: float, unit: str) -> str:
    """Format a quantity in its SI unit and, in brackets, in the customary unit.

    Args:
        name: name of the quantity.
        value: value in SI.
        unit: SI unit; empty for a dimensionless number.

    Returns:
        For example "input_speed = 1000 rad/s (9549 rpm)".
    """
    from ..units.conversion import customary

    usual = customary(value, unit)
    return f"{name} = {value:g} {unit}".rstrip() + (f" ({usual})" if usual else "")
