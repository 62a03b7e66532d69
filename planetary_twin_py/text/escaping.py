"""Escapes control characters in text of unknown origin, for printing to a terminal."""

from __future__ import annotations

LONGEST_NAME = 100  # characters; names in ROS have at most 255, most have 40


def printable(text: str) -> str:
    """`text` with control characters escaped, except line ends and tabs."""
    if text.isprintable():
        return text
    return "".join(c if c.isprintable() or c in "\n\t" else ascii(c)[1:-1] for c in text)


def one_line(text: str, longest: int) -> str:
    """`text` as one line; if it is longer than `longest` characters, its middle is omitted."""
    line = printable(text).replace("\n", "\\n").replace("\t", " ")
    if len(line) <= longest:
        return line
    half = longest // 2 - 3
    return f"{line[:half]} ... {line[-half:]}"
