"""Units of a message's fields, as the definition that travels in the file tells them."""

from __future__ import annotations

import re

_FIELD = re.compile(r"^\S+\s+(\w+)\s*#\s*\[([^\]]+)\]", re.MULTILINE)
_NEXT_TYPE = "=" * 80


def units_of(definition: str) -> dict[str, str]:
    """Unit by name of those fields that tell one; "-" is that of pure numbers.

    `definition` is the text of a .msg file, with or without the types it refers to.
    """
    return dict(_FIELD.findall(definition.partition(_NEXT_TYPE)[0]))
