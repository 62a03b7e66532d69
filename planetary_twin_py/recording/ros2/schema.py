"""Message definitions in the `ros2msg` encoding of MCAP, including all referenced types."""

from __future__ import annotations

import os
import re
import sys
from collections.abc import Callable
from pathlib import Path

_PRIMITIVES = {"bool", "byte", "char", "float32", "float64", "string", "wstring"} | {
    f"{sign}int{bits}" for sign in ("", "u") for bits in (8, 16, 32, 64)
}
_SEPARATOR = "=" * 80
# "pkg/Type[<=3] name" -> "pkg/Type", without bounds of strings and arrays
_FIELD_TYPE = re.compile(r"^\s*([A-Za-z]\w*(?:/\w+)*)")


def message_definition(type_name: str, read: Callable[[str], str] | None = None) -> str:
    """Definition of a type and of all types that it references, in the format of rosbag2.

    Args:
        type_name: `pkg/msg/Name`.
        read: returns the text of one type; by default that of the installed .msg file.

    Raises:
        FileNotFoundError: a definition is not installed.
    """
    read = read or installed_definition
    parts = [read(type_name)]
    seen = {type_name}
    queue = _references(parts[0], type_name)
    while queue:
        name = queue.pop(0)
        if name in seen:
            continue
        seen.add(name)
        text = read(name)
        package, _, short = name.split("/")
        parts.append(f"{_SEPARATOR}\nMSG: {package}/{short}\n{text}")
        queue += _references(text, name)
    return "\n".join(parts)


def installed_definition(type_name: str) -> str:
    """Text of the installed .msg file of `pkg/msg/Name`."""
    package, kind, name = type_name.split("/")
    # A sourced ROS lists its prefixes; ROS from wheels is in the prefix of the interpreter.
    prefixes = [p for p in os.environ.get("AMENT_PREFIX_PATH", "").split(os.pathsep) if p]
    for prefix in [*prefixes, sys.prefix]:
        file = Path(prefix, "share", package, kind, f"{name}.msg")
        if file.is_file():
            return file.read_text(encoding="utf-8")
    raise FileNotFoundError(
        f"{type_name}: its definition {package}/{kind}/{name}.msg is not installed"
    )


def _references(text: str, owner: str) -> list[str]:
    """Full names of the message types of the fields in `text`."""
    package = owner.split("/")[0]
    names = []
    for line in text.splitlines():
        match = _FIELD_TYPE.match(line.split("#", 1)[0])
        if not match or match[1] in _PRIMITIVES:
            continue
        parts = match[1].split("/")
        names.append("/".join((parts[0] if len(parts) > 1 else package, "msg", parts[-1])))
    return names
