"""The command line, from the Typer application."""

import re

import typer
from typer.cli import get_docs_for_click

from planetary_twin_py.cli import build_app

_TITLE = "# Command line\n\nGenerated from the application that `planetary-twin --help` shows.\n"


def page() -> str:
    """A section for every command, as `--help` has it."""
    command = typer.main.get_command(build_app())
    context = typer.Context(command, info_name="planetary-twin")
    text = get_docs_for_click(obj=command, ctx=context, name="planetary-twin")
    return _TITLE + re.sub(r"^(#+ )", r"#\1", text, flags=re.MULTILINE)
