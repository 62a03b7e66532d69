"""Text of unknown origin, as a terminal can show it without obeying it."""

from __future__ import annotations


def printable(text: str) -> str:
    """`text` with an escape for each character that would steer a terminal, but for line ends."""
    if text.isprintable():
        return text
    return "".join(c if c.isprintable() or c in "\n\t" else ascii(c)[1:-1] for c in text)


def one_line(text: str, longest: int) -> str:
    """`text` as one line, without its middle where it has more than `longest` characters."""
    line = printable(text).replace("\n", "\\n").replace("\t", " ")
    if len(line) <= longest:
        return line
    half = longest // 2 - 3
    return f"{line[:half]} ... {line[-half:]}"
