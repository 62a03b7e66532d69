"""What all commands share: plain help with examples as one types them, and how runs fail."""

from __future__ import annotations

import inspect
from typing import Any

from typer.core import TyperCommand

from ._fail import fail

PLAIN = None  # Rich would take "[s]" for markup
_EXAMPLE = "\n\nExample: "


class Command(TyperCommand):
    """A command whose docstring ends in an example; its lines are kept, as a shell needs them."""

    def __init__(self, name: str | None, *, help: str | None = None, **attributes: Any) -> None:
        told, _, example = inspect.cleandoc(help or "").partition(_EXAMPLE)
        self.example = example.splitlines()
        super().__init__(name, help=told, **attributes)

    def invoke(self, ctx: Any) -> Any:
        """Run the command; a run that cannot go on ends it with one line."""
        try:
            return super().invoke(ctx)
        except ArithmeticError as error:
            from ..runaway import RunawayError  # loads the compiler, which has run by now

            if not isinstance(error, RunawayError):
                raise
            fail(error, 1)

    def format_epilog(self, ctx: Any, formatter: Any) -> None:
        """Write the example."""
        if self.example:
            with formatter.section("Example"):
                formatter.write("  " + " \\\n    ".join(self.example) + "\n")
