"""Messages on stderr, one line each; a user's error ends the command with exit code 2."""

from __future__ import annotations

import re
import warnings
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from importlib.util import find_spec
from typing import NoReturn

import typer

_OPTIONS: ContextVar[dict[str, str]] = ContextVar("_OPTIONS")  # by argument


@contextmanager
def naming_options(options: Iterable[str]) -> Iterator[None]:
    """Context in which `fail` names options where an exception names arguments of a function.

    Args:
        options: options of the command, such as "--sample-rate".
    """
    arguments = {option.removeprefix("--").replace("-", "_"): option for option in options}
    token = _OPTIONS.set(arguments)
    try:
        yield
    finally:
        _OPTIONS.reset(token)


@contextmanager
def one_line_errors(*further: type[Exception]) -> Iterator[None]:
    """Context in which an error of the user or of the system ends the command, see `fail`.

    Args:
        further: exceptions that do, in addition to `ValueError` and `OSError`.
    """
    kinds: tuple[type[Exception], ...] = (ValueError, OSError, *further)
    try:
        yield
    except kinds as error:
        fail(error)


def fail(message: object, code: int = 2) -> NoReturn:
    """Print `message` as one line and end the command.

    Args:
        message: text, or an exception; one of the system is shown as file and reason. Of others,
            `argument = value` is shown as `--option = value`, see `naming_options`, but in those of
            a scene, which name its fields.
        code: exit code.

    Raises:
        typer.Exit: always.
    """
    if isinstance(message, OSError) and message.strerror:
        named = () if message.filename is None else (str(message.filename),)
        message = ": ".join((*named, message.strerror))
    elif isinstance(message, Exception) and not _of_a_scene(message):
        message = _with_options(str(message))
    _say(f"planetary-twin: {message}", "red")
    raise typer.Exit(code)


def _of_a_scene(error: Exception) -> bool:
    from ..scene import SceneError  # Pydantic, which many commands do not load

    return isinstance(error, SceneError)


def _with_options(text: str) -> str:
    """`text` with options in place of arguments, where it states their values."""
    options = _OPTIONS.get({})
    return re.sub(r"(?<![\w.-])\w+(?= = )", lambda found: options.get(found[0], found[0]), text)


def remark(message: str) -> None:
    """Print a warning; the command continues."""
    _say(f"planetary-twin: {message}", "yellow")


def warn(messages: Iterable[str | None]) -> None:
    """Print warnings about results; the command continues.

    Args:
        messages: sentences; those that are empty or None are left out.
    """
    for message in filter(None, messages):
        remark(f"warning: {message}")


def ignore_remarks() -> None:
    """Do not print Python warnings about accuracy and energy: the command prints its remarks."""
    from ..text.warning_types import AccuracyWarning, LedgerWarning

    for kind in (AccuracyWarning, LedgerWarning):
        warnings.simplefilter("ignore", kind)


def note(message: str) -> None:
    """Print a line that says how an argument was interpreted."""
    _say(f"planetary-twin: {message}", "")


def need(extra: str, *modules: str) -> None:
    """End the command if one of `modules`, which the `extra` installs, is missing."""
    if any(find_spec(module) is None for module in modules):
        fail(f"required packages are missing: pip install 'planetary_twin_py[{extra}]'")


def _say(line: str, colour: str) -> None:
    from rich.console import Console  # honours NO_COLOR and pipes

    from ..text.escaping import printable

    Console(stderr=True).print(
        printable(line), style=colour, markup=False, emoji=False, highlight=False, soft_wrap=True
    )
