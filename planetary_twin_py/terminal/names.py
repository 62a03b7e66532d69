"""Names of unknown origin, of topics and scenes, in text that Rich prints."""

from __future__ import annotations


def shown(name: str) -> str:
    """A name as a part of one line, without control characters and markup.

    Returns:
        The name; of a longer one than 100 characters the middle is omitted.
    """
    from rich.markup import escape

    from ..text.escaping import LONGEST_NAME, one_line

    return escape(one_line(name, LONGEST_NAME))
