"""Reads YAML files of users."""

from __future__ import annotations

from pathlib import Path
from typing import TypeVar

from pydantic import ValidationError

from .defect import explain
from .quantity import SceneError, Section
from .yaml_text import read_yaml

_Model = TypeVar("_Model", bound=Section)


def read_text(path: Path) -> str:
    """Text of a regular file.

    Raises:
        SceneError: the path is a pipe, a device or a folder, or the text is not in UTF-8.
        OSError: the file cannot be read.
    """
    if path.exists() and not path.is_file():
        raise SceneError("must be a file")  # opening a pipe would wait for a writer
    try:
        return path.read_text("utf-8")
    except UnicodeDecodeError as error:
        raise SceneError(f"must be in UTF-8, byte {error.start + 1} is not") from None


def read_section(path: Path, model: type[_Model]) -> _Model:
    """Read a YAML file with the fields of a section.

    Args:
        path: of the file; an empty one gives the defaults.
        model: the section.

    Raises:
        SceneError: the file is not such a file, or a field is invalid; the message starts with the
            path.
        OSError: the file cannot be read.
    """
    try:
        return model.model_validate(read_yaml(read_text(path), "file") or {})
    except ValidationError as error:
        raise SceneError(f"{path}: {explain(error, model, what='the file')}") from None
    except SceneError as error:
        raise SceneError(f"{path}: {error}") from None
