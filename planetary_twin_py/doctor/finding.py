"""What is found of one part of an installation."""

from __future__ import annotations

from typing import Literal, NamedTuple

State = Literal["sound", "absent", "broken"]


class Finding(NamedTuple):
    """A part, in which state it is, and in one line each what was found and how to mend it.

    "absent" is a part that one may do without, "broken" one that does not do what it is there for.
    """

    part: str
    state: State
    told: str
    mend: str = ""
