"""YAML text as plain data, within limits that no scene needs to pass.

A key that stands twice is refused: YAML would take the last. So are aliases that make a small text
large, and nesting without end.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import yaml

from .quantity import SceneError, listed

# That of libyaml, which every wheel of PyYAML holds, is ten times as fast.
_Loader: Any = getattr(yaml, "CSafeLoader", yaml.SafeLoader)
LONGEST = 100_000  # characters of a text
_MOST_VALUES = 5_000  # with each alias as what it stands for
_DEEPEST = 50  # mappings and lists within one another


def read_yaml(text: str, what: str = "scene") -> Any:
    """Plain data of a YAML text.

    Args:
        text: YAML.
        what: the text is of, for the message of an error.

    Returns:
        Mappings, lists and scalars.

    Raises:
        SceneError: the text is not YAML, is too large, or gives a key of a mapping twice.
    """
    if len(text) > LONGEST:
        raise SceneError(f"{what} has {len(text)} characters: must be at most {LONGEST}")
    try:
        _check_size(text, what)
        loader = _Loader(text)
        root = loader.get_single_node()
        if repeated := list(_repeated(root, "", set())):
            raise SceneError(listed(repeated))
        return None if root is None else loader.construct_document(root)
    except yaml.YAMLError as error:
        raise SceneError(f"{what} is not YAML: {' '.join(str(error).split())}") from None
    except SceneError:
        raise
    except Exception as error:  # of any kind, where a tag like !!int is given what is none
        raise SceneError(f"{what} holds what is not of its tag: {listed([str(error)])}") from None


def _check_size(text: str, what: str) -> None:
    """Raise `SceneError` where a text is deeper than a scene, or larger with its aliases."""
    values, sizes = 0, dict[str | None, int]()
    opened: list[tuple[str | None, int]] = []  # anchor of each collection, and values before it
    for event in yaml.parse(text, Loader=_Loader):
        if isinstance(event, yaml.CollectionStartEvent):
            opened.append((event.anchor, values))
            values += 1
        elif isinstance(event, yaml.CollectionEndEvent):
            anchor, before = opened.pop()
            sizes[anchor] = values - before
        elif isinstance(event, yaml.ScalarEvent):
            values += 1
            sizes[event.anchor] = 1
            event.value.encode()  # no half of a pair of UTF-16, which nothing can print
        elif isinstance(event, yaml.AliasEvent):
            if event.anchor in [anchor for anchor, _ in opened]:
                raise SceneError(f"{what} holds itself: *{event.anchor} stands in &{event.anchor}")
            values += sizes.get(event.anchor, 1)
        if values > _MOST_VALUES:
            raise SceneError(f"{what} has more than {_MOST_VALUES} values, the most that are read")
        if len(opened) > _DEEPEST:
            raise SceneError(f"{what} is nested deeper than {_DEEPEST} levels")


def _repeated(node: yaml.Node | None, path: str, seen: set[int]) -> Iterator[str]:
    """A line for each key that stands twice below `node`; an alias counts once."""
    if node is None or id(node) in seen:
        return
    seen.add(id(node))
    if isinstance(node, yaml.SequenceNode):
        for place, entry in enumerate(node.value):
            yield from _repeated(entry, f"{path}{place}.", seen)
    elif isinstance(node, yaml.MappingNode):
        lines: dict[str, int] = {}
        for key, value in node.value:
            name, line = str(key.value), key.start_mark.line + 1
            if name in lines:
                yield f"{path}{name}: given twice, in line {lines[name]} and in line {line}"
            lines.setdefault(name, line)
            yield from _repeated(value, f"{path}{name}.", seen)
