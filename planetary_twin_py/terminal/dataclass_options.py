"""Commands whose arguments and options are the fields of a dataclass."""

from __future__ import annotations

import inspect
from collections.abc import Callable
from typing import Any, get_type_hints


def take_options_of(options: type, command: Callable[..., Any]) -> None:
    """Give a command the fields of a dataclass, and of those it inherits from, as arguments.

    Typer reads them from the signature.

    Args:
        options: dataclass whose fields are annotated with `typer.Argument` and `typer.Option`.
        command: takes them by keyword.
    """
    hints = get_type_hints(options, include_extras=True)
    parameters = [
        parameter.replace(annotation=hints[name])
        for name, parameter in inspect.signature(options).parameters.items()
    ]
    vars(command)["__signature__"] = inspect.Signature(parameters, return_annotation=None)
