"""`--json FILE`: results as JSON, in addition to the printed text."""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

from .console import make_console
from .messages import fail

if TYPE_CHECKING:
    from .tables import TableConsole


def console_beside(target: str | None) -> TableConsole:
    """Console for text: standard output, or standard error if JSON goes to standard output."""
    return make_console(stderr=target == "-")


def write_json(figures: Any, target: str | None) -> None:
    """Write `figures` as JSON to the file `target`; "-" is standard output, None writes none."""
    if target is None:
        return
    text = json.dumps(figures, indent=2) + "\n"
    if target == "-":
        sys.stdout.write(text)
        return
    try:
        Path(target).write_text(text, "utf-8")
    except OSError as error:
        fail(f"--json = {target!r}: {error.strerror}")
