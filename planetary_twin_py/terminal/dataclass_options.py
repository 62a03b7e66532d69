"""Commands whose arguments and options are the fields of a dataclass."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Mapping
from typing import Any, get_type_hints


def take_options_of(
    options: type, command: Callable[..., Any], files: Mapping[str, Any] | None = None
) -> None:
    """Give a command the fields of a dataclass, and of those it inherits from, as arguments.

    Typer reads them from the signature.

    Args:
        options: dataclass whose fields are annotated with `typer.Argument` and `typer.Option`.
        command: takes them by keyword.
        files: annotations of further options by name, None by default, before the others.
    """
    hints = get_type_hints(options, include_extras=True)
    parameters = [
        parameter.replace(annotation=hints[name])
        for name, parameter in inspect.signature(options).parameters.items()
    ]
    optional = [parameter.default is not inspect.Parameter.empty for parameter in parameters]
    first = optional.index(True)
    parameters[first:first] = [
        inspect.Parameter(
            name, inspect.Parameter.POSITIONAL_OR_KEYWORD, default=None, annotation=annotation
        )
        for name, annotation in (files or {}).items()
    ]
    vars(command)["__signature__"] = inspect.Signature(parameters, return_annotation=None)
