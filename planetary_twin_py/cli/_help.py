"""How help is written: plainly, with units in brackets, and examples as one types them."""

from __future__ import annotations

import inspect
from typing import Any

from typer.core import TyperCommand

PLAIN = None  # Rich would take "[s]" for markup
_EXAMPLE = "\n\nExample: "


class Command(TyperCommand):
    """A command whose docstring ends in an example; its lines are kept, as a shell needs them."""

    def __init__(self, name: str | None, *, help: str | None = None, **attributes: Any) -> None:
        told, _, example = inspect.cleandoc(help or "").partition(_EXAMPLE)
        self.example = example.splitlines()
        super().__init__(name, help=told, **attributes)

    def format_epilog(self, ctx: Any, formatter: Any) -> None:
        """Write the example."""
        if self.example:
            with formatter.section("Example"):
                formatter.write("  " + " \\\n    ".join(self.example) + "\n")
