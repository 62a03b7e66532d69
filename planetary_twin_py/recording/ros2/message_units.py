"""Units of message fields, from comments in the definition in the file."""

from __future__ import annotations

import re

_FIELD = re.compile(r"^\S+\s+(\w+)\s*#\s*\[([^\]]+)\]", re.MULTILINE)
_NEXT_TYPE = "=" * 80


def units_of(definition: str) -> dict[str, str]:
    """Units of the fields that state one.

    Args:
        definition: text of a .msg file, with or without referenced types.

    Returns:
        Unit by field name; "-" for dimensionless numbers.
    """
    return dict(_FIELD.findall(definition.partition(_NEXT_TYPE)[0]))
