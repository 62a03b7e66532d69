"""Runs `planetary-twin` as a user does."""

import os
import subprocess
import sys

COMMAND = [sys.executable, "-c", "from planetary_twin_py.cli import main; main()"]


def run(*arguments, prelude="", **environment):
    """What it prints; `prelude` is run in the same process before."""
    code = f"{prelude}\nfrom planetary_twin_py.cli import main; main()"
    return subprocess.run(
        [sys.executable, "-c", code, *map(str, arguments)],
        capture_output=True,
        text=True,
        timeout=600,
        env=os.environ | environment,
    )
