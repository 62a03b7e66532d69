"""A command takes the fields of a dataclass and of its bases."""

from __future__ import annotations

import inspect
from dataclasses import dataclass
from typing import Annotated

from planetary_twin_py.terminal.dataclass_options import take_options_of


@dataclass(frozen=True)
class First:
    """A base with annotations as text."""

    file: Annotated[str, "argument"]
    rate: Annotated[float, "option"] = 2.0


@dataclass(frozen=True)
class Second(First):
    """More options."""

    gear: Annotated[str, "further"] = "sun"


def test_fields_of_all_bases_and_files_are_parameters_with_their_annotations():
    def command(**given):
        return Second(**given)

    take_options_of(Second, command, {"log": Annotated[str | None, "path"]})
    found = inspect.signature(command).parameters
    assert list(found) == ["file", "log", "rate", "gear"]
    assert (found["log"].default, found["rate"].default) == (None, 2.0)
    assert [each.annotation.__metadata__ for each in found.values()] == [
        ("argument",), ("path",), ("option",), ("further",)
    ]  # fmt: skip
