"""Checks that what a caller gives as a scene is one."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from pathlib import Path

from ..text.escaping import one_line
from .quantity import SceneError
from .scene import Scene

_LONGEST = 60  # characters of a value in a message


def check_scene(scene: object, name: str = "scene") -> None:
    """Raise `SceneError` unless `scene`, the argument `name`, is a `Scene`."""
    if not isinstance(scene, Scene):
        raise SceneError(f"{name} = {_brief(scene)}: must be a Scene; {_source(scene)}")


def given_scenes(scenes: Iterable[Scene]) -> Iterator[Scene]:
    """Return an iterator that checks each of `scenes`, by its place.

    Raises:
        SceneError: `scenes` is a single scene, its name, or no iterable.
    """
    if isinstance(scenes, (str, Scene)) or not isinstance(scenes, Iterable):
        value = "a Scene" if isinstance(scenes, Scene) else _brief(scenes)
        raise SceneError(f"scenes = {value}: must be several, for example a list of Scene")
    return _checked(scenes)


def _checked(scenes: Iterable[Scene]) -> Iterator[Scene]:
    for place, scene in enumerate(scenes):
        check_scene(scene, f"scenes[{place}]")
        yield scene


def _source(given: object) -> str:
    """Return how to make a scene of what is given in its place."""
    if isinstance(given, (str, Path)):
        quoted = one_line(str(given), _LONGEST).replace('"', '\\"')
        return f'load_scene("{quoted}") gives it'
    return "load_scene and parse_scene give one"


def _brief(given: object) -> str:
    return one_line(repr(given), _LONGEST)
