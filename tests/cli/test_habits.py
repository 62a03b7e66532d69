"""Conventions of commands: exit codes, colours, pipes, Ctrl-C."""

import os
import pty
import signal
import subprocess
import time
from pathlib import Path

import pytest
from command_line import COMMAND, run

MISTAKES = (["simulte"], ["simulate", "--durration", "1"], ["simulate", "papyrus"], ["sweep"])


@pytest.mark.parametrize("arguments", MISTAKES, ids=" ".join)
def test_invalid_arguments_end_with_2_and_without_a_traceback(arguments, tmp_path):
    done = run(*arguments)
    assert done.returncode == 2
    assert done.stderr and "Traceback" not in done.stderr


def test_success_ends_with_0_and_an_empty_error_stream():
    done = run("modal")
    assert (done.returncode, done.stderr) == (0, "")


def printed_on_a_terminal(**environment):
    """Everything that a mistake prints on a terminal."""
    ours, theirs = pty.openpty()
    subprocess.run(
        [*COMMAND, "simulate", "papyrus"],
        stdout=theirs,
        stderr=theirs,
        env=os.environ | {"TERM": "xterm-256color"} | environment,
        timeout=120,
    )
    os.close(theirs)
    with open(ours, "rb") as terminal:
        return terminal.read1(10000)


@pytest.mark.exhaustive
def test_colours_are_used_on_terminals_unless_disabled():
    assert b"\x1b[31m" in printed_on_a_terminal()
    assert b"\x1b[" not in printed_on_a_terminal(NO_COLOR="1")
    assert b"\x1b[" not in printed_on_a_terminal(TERM="dumb")
    assert "\x1b[" not in run("simulate", "papyrus", TERM="xterm-256color").stderr


def test_a_reader_that_closes_the_pipe_is_no_error():
    process = subprocess.Popen(
        [*COMMAND, "modal"], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    )
    process.stdout.close()
    errors = process.stderr.read()
    assert process.wait(120) == 1
    assert "Traceback" not in errors and "BrokenPipe" not in errors


def busy_threads(process):
    """Threads, except the first, that have computed for a while."""
    first = str(process.pid)
    busy = 0
    for thread in Path(f"/proc/{process.pid}/task").iterdir():
        ticks = int((thread / "stat").read_text().rpartition(")")[2].split()[11])
        busy += thread.name != first and ticks > 0.3 * os.sysconf("SC_CLK_TCK")
    return busy


@pytest.mark.slow
def test_ctrl_c_ends_a_long_command_at_once(tmp_path):
    process = subprocess.Popen(
        [*COMMAND, "simulate", "--duration", "300"],
        cwd=tmp_path,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
        text=True,
    )
    try:
        deadline = time.monotonic() + 120.0
        while not busy_threads(process):
            assert time.monotonic() < deadline and process.poll() is None
            time.sleep(0.05)
        process.send_signal(signal.SIGINT)
        _, errors = process.communicate(timeout=120)
    finally:
        process.kill()
    assert process.returncode == 130
    assert "Traceback" not in errors
