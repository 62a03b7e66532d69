"""Result of checking one part of the installation."""

from __future__ import annotations

from typing import Literal, NamedTuple

State = Literal["sound", "absent", "broken"]


class Finding(NamedTuple):
    """A part, its state, and one line each of details and fix.

    An "absent" part is optional; a "broken" part does not work.
    """

    part: str
    state: State
    details: str
    fix: str = ""
