"""YAML text as plain data. A key that stands twice is refused: YAML would take the last."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import yaml

from .quantity import SceneError, listed


def read_yaml(text: str, what: str = "scene") -> Any:
    """Plain data of a YAML text.

    Args:
        text: YAML.
        what: the text is of, for the message of an error.

    Returns:
        Mappings, lists and scalars.

    Raises:
        SceneError: the text is not YAML, or gives a key of a mapping twice.
    """
    try:
        loader = yaml.SafeLoader(text)
        root = loader.get_single_node()
        if repeated := list(_repeated(root, "", set())):
            raise SceneError(listed(repeated))
        return None if root is None else loader.construct_document(root)
    except yaml.YAMLError as error:
        raise SceneError(f"{what} is not YAML: {' '.join(str(error).split())}") from None


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
