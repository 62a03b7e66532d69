"""Nodes as separate processes: executed as by users, or forked from a process with the imports."""

import functools
import importlib
import multiprocessing
import os
import signal
import subprocess
import sys
import threading
from contextlib import suppress
from multiprocessing.connection import Connection
from multiprocessing.context import ForkServerProcess
from multiprocessing.forkserver import ensure_running
from pathlib import Path
from typing import IO, Any

import pytest

from .peer import LONG

_WARM = multiprocessing.get_context("forkserver")


@functools.cache
def _warm_up() -> None:
    """
    Start the process from which nodes are forked.

    A node spends most of its start on imports and on loading the core: here this happens once for
    each test runner.
    """
    _WARM.set_forkserver_preload(["ros.warm"])
    with pytest.MonkeyPatch.context() as environment:
        # Python 3.11 gives that process no search path of the tests.
        paths = str(Path(__file__).parents[1]), os.environ.get("PYTHONPATH")
        environment.setenv("PYTHONPATH", os.pathsep.join(filter(None, paths)))
        ensure_running()


class _Lines:
    """Reads a stream continuously: the writer would block once the pipe is full."""

    def __init__(self, pipe: IO[str]) -> None:
        self._lines: list[str] = []
        self._reader = threading.Thread(target=self._read, args=[pipe], daemon=True)
        self._reader.start()

    def text(self) -> str:
        """All lines, once the writer has ended."""
        self._reader.join()
        return "".join(self._lines)

    def _read(self, pipe: IO[str]) -> None:
        with pipe:
            self._lines += pipe


class Executed(subprocess.Popen[str]):
    """A module run by a separate interpreter."""

    def __init__(self, module: str, *arguments: str, cwd: Path) -> None:
        super().__init__(
            [sys.executable, "-m", module, *arguments],
            cwd=cwd,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        )
        assert self.stderr is not None
        self._errors, self.stderr = _Lines(self.stderr), None

    def communicate(self, *given: Any, **options: Any) -> tuple[str, str]:
        """Standard output and standard error, once the process has ended."""
        output, _ = super().communicate(*given, **options)
        return output, self._errors.text()

    def close(self) -> None:
        """Close the pipe."""
        self.stdout.close()


# With tolerance 0, the default, a simulation spends spare time of the processor on accuracy, here
# time that other tests need.
_FRUGAL = {"planetary_twin.simulation": ("--ros-args", "-p", "tolerance:=0.001")}


class Forked:
    """A module run in a process forked from a warm one; used as `Executed`.

    A simulation has a fixed tolerance unless `arguments` give another.
    """

    def __init__(self, module: str, *arguments: str, cwd: Path) -> None:
        arguments = *_FRUGAL.get(module, ()), *arguments
        _warm_up()
        output, its_output = _WARM.Pipe(duplex=False)
        errors, its_errors = _WARM.Pipe(duplex=False)
        state = str(cwd), dict(os.environ), its_output, its_errors
        self._process: ForkServerProcess = _WARM.Process(
            target=_run, args=(module, arguments, *state), daemon=True
        )
        self._process.start()
        its_output.close()
        its_errors.close()
        self.pid = self._process.pid
        self._output, self._errors = _Lines(_text(output)), _Lines(_text(errors))

    @property
    def returncode(self) -> int | None:
        """Exit code as last polled; None while it runs."""
        return self._process.exitcode

    def poll(self) -> int | None:
        """Exit code; None while it runs."""
        return self._process.exitcode

    def wait(self, timeout: float | None = None) -> int:
        """Exit code; raises `TimeoutExpired` if it still runs after `timeout`."""
        self._process.join(timeout)
        if (code := self._process.exitcode) is None:
            raise subprocess.TimeoutExpired(str(self.pid), timeout)
        return code

    def communicate(self, timeout: float | None = None) -> tuple[str, str]:
        """Standard output and standard error, once the process has ended."""
        self.wait(timeout)
        return self._output.text(), self._errors.text()

    def send_signal(self, number: int) -> None:
        """Send a signal, unless the process has ended."""
        if self._process.exitcode is None:
            with suppress(ProcessLookupError):  # its exit code is on the way
                os.kill(self.pid, number)

    def terminate(self) -> None:
        self.send_signal(signal.SIGTERM)

    def kill(self) -> None:
        self.send_signal(signal.SIGKILL)

    def close(self) -> None:
        """Do nothing: both streams are read to their end."""


Program = Executed | Forked


def _text(pipe: Connection) -> IO[str]:
    duplicate = os.dup(pipe.fileno())
    pipe.close()
    return open(duplicate, errors="replace")  # closed by the reader


def _run(
    module: str,
    arguments: tuple[str, ...],
    cwd: str,
    environment: dict[str, str],
    output: Connection,
    errors: Connection,
) -> None:
    """Become `python -m module arguments`."""
    for number, pipe in ((1, output), (2, errors)):
        os.dup2(pipe.fileno(), number)
        pipe.close()
    os.chdir(cwd)
    os.environ.clear()
    os.environ.update(environment)
    program = importlib.import_module(module)
    if not hasattr(program, "main"):  # the folder of a node
        program = importlib.import_module(f"{module}.node")
    sys.argv = [str(program.__file__), *arguments]
    sys.exit(program.main())


def outcome(
    process: Program | subprocess.Popen[str], code: int = 0, timeout: float = LONG
) -> tuple[str, str]:
    """Its output and its errors, once it has ended with `code` and without a traceback."""
    output, errors = process.communicate(timeout=timeout)
    assert process.returncode == code, errors
    assert "Traceback" not in errors
    return output, errors


def ended(process: Program | subprocess.Popen[str], code: int = 0) -> str:
    """Its standard error, once it has ended with `code` and without a traceback."""
    return outcome(process, code)[1]


def refuses(process: Program | subprocess.Popen[str], *reasons: str, code: int = 1) -> str:
    """The one line with which it ends, which contains the reasons."""
    errors = ended(process, code)
    (line,) = [line for line in errors.strip().splitlines() if "[INFO]" not in line]
    assert all(reason in line for reason in reasons), line
    return line
