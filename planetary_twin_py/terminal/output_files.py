"""Output files: checked while the options are read, before anything is computed, and written."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any, TypeVar

import typer

from .messages import fail

PICTURES = (".png", ".svg", ".pdf")  # formats of pictures
TABLES = (".parquet", ".csv", ".npz")  # formats of tables
STUDY_TABLES = (".parquet", ".csv")  # those of studies
Target = TypeVar("Target", Path, str)


def output_file(
    context: typer.Context, param: typer.CallbackParam, value: Target | None
) -> Target | None:
    """Callback of an option that names a file: end the command if it cannot be written."""
    if value is not None and str(value) != "-" and not context.resilient_parsing:
        check_file(_option(param), Path(value))
    return value


def file_ending_in(*suffixes: str) -> Callable[..., Any]:
    """Callback as `output_file` of an option whose file has one of some formats.

    Args:
        suffixes: of the formats, with their dots.

    Returns:
        The callback, which also ends the command if the file has another suffix.
    """

    def check(
        context: typer.Context, param: typer.CallbackParam, value: Target | None
    ) -> Target | None:
        if value is not None and Path(value).suffix not in suffixes:
            _refuse(_option(param), Path(value), f"must end in {', '.join(suffixes)}")
        checked = output_file(context, param, value)
        if value is not None and Path(value).exists() and not Path(value).is_file():
            _refuse(_option(param), Path(value), "must be a file")  # a pipe would wait for a reader
        return checked

    return check


def check_file(option: str, path: Path) -> None:
    """End the command if the file `path` cannot be written.

    Args:
        option: name of the option that gives the path, e.g. "--out".
        path: a file, which may exist.
    """
    try:
        if path.is_dir():
            _refuse(option, path, "is a folder; name a file")
        if path.exists() and not os.access(path, os.W_OK):
            _refuse(option, path, "is not writable")
        _check_folder(option, path, path.parent)
    except OSError as error:  # of a name that is too long
        _refuse(option, path, str(error.strerror))


def check_recording(option: str, path: Path) -> None:
    """End the command if no recording can be created at `path`.

    Args:
        option: name of the option that gives the path, e.g. "--out".
        path: a folder, whose parents are created, or one file NAME.mcap; it must not exist.
    """
    try:
        if path.exists():
            _refuse(option, path, "already exists; choose another name")
        above = path.parent
        while path.suffix != ".mcap" and not above.exists():
            above = above.parent
        _check_folder(option, path, above)
    except OSError as error:  # of a name that is too long
        _refuse(option, path, str(error.strerror))


@contextmanager
def writing(option: str, path: Path) -> Iterator[None]:
    """Context that ends the command in one line if the file of an option cannot be written.

    Args:
        option: name of the option that gives the path, e.g. "--out".
        path: the file.
    """
    try:
        yield
    except (ValueError, OSError) as error:
        _refuse(option, path, str(error))


def _check_folder(option: str, path: Path, folder: Path) -> None:
    if not folder.is_dir():
        wrong = "is not a folder" if folder.exists() else "does not exist"
        _refuse(option, path, f"the folder {folder} {wrong}")
    if not os.access(folder, os.W_OK):
        _refuse(option, path, f"the folder {folder} is not writable")


def _refuse(option: str, path: Path, reason: str) -> None:
    fail(f"{option} = {str(path)!r}: {reason}")


def _option(param: typer.CallbackParam) -> str:
    return str(param.opts[0])
