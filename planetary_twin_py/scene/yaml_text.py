"""Parses YAML text.

Duplicate keys, of which YAML would use the last, are rejected. Numbers are decimal: what YAML 1.1
would read as octal (010), hexadecimal, binary, in base 60 (1:30) or with underscores is text.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import yaml

from .decimal_loader import DecimalLoader
from .quantity import SceneError, listed

LONGEST = 100_000  # characters of a text
_UNNAMED = 'in "<unicode string>", '  # before a line, in messages of PyYAML


def read_yaml(text: str, what: str = "scene") -> Any:
    """Parse a YAML text.

    Args:
        text: YAML.
        what: name of the text in error messages.

    Returns:
        Mappings, lists and scalars.

    Raises:
        SceneError: the text is not YAML, is too large, or has a duplicate key.
    """
    if len(text) > LONGEST:
        raise SceneError(f"{what} has more than {LONGEST} characters, the most that are read")
    try:
        loader = DecimalLoader(text)
        root = loader.get_single_node()
        if repeated := list(_repeated(root, "", set())):
            raise SceneError(listed(repeated, f"the {what}"))
        return None if root is None else loader.construct_document(root)
    except yaml.YAMLError as error:
        reason = str(error).replace(_UNNAMED, "at ")
        raise SceneError(f"{what} is not YAML: {' '.join(reason.split())}") from None
    except SceneError:
        raise
    except Exception as error:  # of many kinds, if a value does not match a tag such as !!int
        reason = listed([str(error)])
        raise SceneError(f"{what} has a value that does not match its tag: {reason}") from None


def _repeated(node: yaml.Node | None, path: str, seen: set[int]) -> Iterator[str]:
    """A line for each duplicate key below `node`; an alias counts once."""
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
                places = f"in line {lines[name]} and in line {line}"
                if line == lines[name]:
                    places = f"in line {line}"
                yield f"{path}{name}: given twice, {places}"
            lines.setdefault(name, line)
            yield from _repeated(value, f"{path}{name}.", seen)
