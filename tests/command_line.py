"""Runs `planetary-twin`: as a user does, or in this process, which has its imports already."""

import os
import subprocess
import sys

from typer.testing import CliRunner

from planetary_twin_py.cli import build_app

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


def invoke(*arguments, **environment):
    """The same in this process: a result of Typer with exit_code, output, stdout and stderr."""
    return CliRunner(env=environment).invoke(build_app(), [*map(str, arguments)])


def succeed(*arguments, **environment):
    """The same of a command that must end with 0."""
    done = invoke(*arguments, **environment)
    assert done.exit_code == 0, done.output
    return done


def run_here(*arguments, **environment):
    """The same in this process, for commands that a test only wants to have run."""
    done = invoke(*arguments, **environment)
    if done.exception and not isinstance(done.exception, SystemExit):
        raise done.exception
    return subprocess.CompletedProcess(arguments, done.exit_code, done.stdout, done.stderr)
