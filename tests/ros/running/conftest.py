"""The command `planetary-twin run`, without the imports of the other commands."""

import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

COMMAND = (
    "-c", "import typer; from planetary_twin.running.command import run; app = typer.Typer(); "
    "app.command()(run); app()",
)  # fmt: skip
Run = Callable[..., "subprocess.Popen[str]"]


@pytest.fixture
def run(domain: int, tmp_path: Path) -> Run:
    """Start it with options."""

    def start(*options: str) -> subprocess.Popen[str]:
        return subprocess.Popen(
            [sys.executable, *COMMAND, *options],
            cwd=tmp_path,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        )

    return start
