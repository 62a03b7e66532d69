"""Base class of commands: plain help with an example, and one-line errors of failed runs."""

from __future__ import annotations

import inspect
from typing import Any

from typer.core import TyperCommand

from ..terminal.completion import field_options
from ..terminal.messages import fail, naming_options

PLAIN = None  # Rich would read "[s]" as markup
_EXAMPLE = "\n\nExample: "


class Command(TyperCommand):
    """A command whose docstring ends with an example; its line breaks are kept for the shell."""

    def __init__(self, name: str | None, *, help: str | None = None, **attributes: Any) -> None:
        text, _, example = inspect.cleandoc(help or "").partition(_EXAMPLE)
        self.example = example.splitlines()
        super().__init__(name, help=text, **attributes)

    def shell_complete(self, ctx: Any, incomplete: str) -> list[Any]:
        """Complete options, including fields of a scene if the command accepts them."""
        found: list[Any] = super().shell_complete(ctx, incomplete)
        if ctx.ignore_unknown_options and ctx.allow_extra_args and incomplete.startswith("--"):
            (item,) = super().shell_complete(ctx, "--help")
            found += [type(item)(option) for option in field_options(incomplete)]
        return found

    def invoke(self, ctx: Any) -> Any:
        """Run the command; a run that diverges ends it with one line."""
        options = (name for param in self.params for name in param.opts if name.startswith("--"))
        try:
            with naming_options(options):
                return super().invoke(ctx)
        except ArithmeticError as error:
            from ..run.limits import RunawayError  # imports NumPy, which is loaded by now

            if not isinstance(error, RunawayError):
                raise
            fail(error, 1)

    def format_epilog(self, ctx: Any, formatter: Any) -> None:
        """Write the example."""
        if self.example:
            with formatter.section("Example"):
                formatter.write("  " + " \\\n    ".join(self.example) + "\n")
