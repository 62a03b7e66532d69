"""Hostile files: one line, no traceback, and little more processor and memory than sound ones."""

import os
import signal
import subprocess
import sys
import traceback
from typing import NamedTuple

import pytest
from hostile import MESSAGES, READ, REFUSED, SCENES, many_channels, messages_of, rewritten
from tiers import first
from twin_recording import record
from typer.testing import CliRunner

from planetary_twin_py.cli import build_app, main

SLOWER = 2.0  # than `verify` of a sound recording; both take longer on a busy machine
MEGABYTES = 300.0

# A child's own peak: the kernel's figure for it starts with that of the process from which it
# is forked.
COMMAND = """
import atexit, pathlib, sys
status, kept = pathlib.Path("/proc/self/status"), pathlib.Path(sys.argv.pop(1))
atexit.register(lambda: kept.write_text(status.read_text().partition("VmHWM:")[2].split()[0]))
from planetary_twin_py.cli import build_app, main
main()
"""


class Done(NamedTuple):
    code: int
    output: str
    errors: str
    seconds: float
    megabytes: float


def run(*arguments, folder):
    """The output of a command, and its cost."""
    output, errors = folder / "output.txt", folder / "errors.txt"
    command = [sys.executable, "-c", COMMAND, folder / "peak.txt", *map(str, arguments)]
    with output.open("wb") as out, errors.open("wb") as err:
        child = subprocess.Popen(command, stdout=out, stderr=err)
        _, status, used = os.wait4(child.pid, 0)
    child.returncode = os.waitstatus_to_exitcode(status)
    seconds = used.ru_utime + used.ru_stime
    texts = output.read_text("utf-8"), errors.read_text("utf-8")
    peak = int((folder / "peak.txt").read_text()) / 1024
    return Done(child.returncode, *texts, seconds, peak)


def check(done, usual):
    """The command has ended in the usual way."""
    assert done.code in (0, 1, 2), done.errors[-2000:]
    assert "Traceback" not in done.errors
    assert "\x1b" not in done.output + done.errors and "\x07" not in done.output + done.errors
    assert max(map(len, [*done.errors.splitlines(), ""])) < 1000
    assert done.seconds < SLOWER * usual
    assert done.megabytes < MEGABYTES


def check_refused(done, usual):
    check(done, usual)
    assert done.code != 0 and done.output == ""
    assert done.errors.startswith("planetary-twin: ") and done.errors.count("\n") == 1


@pytest.fixture(scope="module")
def sound(tmp_path_factory):
    return record(tmp_path_factory.mktemp("sound") / "bag")


@pytest.fixture(scope="module")
def usual(sound, tmp_path_factory):
    """Processor time [s] for a sound recording on this machine, however busy."""
    done = run("verify", sound, folder=tmp_path_factory.mktemp("usual"))
    assert done.code == 0, done.errors
    return done.seconds


@pytest.mark.slow
@pytest.mark.parametrize("name", first(1, SCENES))
def test_a_hostile_scene_is_refused_in_one_line(usual, tmp_path, name):
    scene = tmp_path / "scene.yaml"
    scene.write_bytes(SCENES[name])
    check_refused(run("explain", scene, folder=tmp_path), usual)


@pytest.mark.parametrize(
    "command",
    first(
        2,
        [
            ["explain"],
            ["info"],
            ["import", "--out", "x.mcap"],
            ["plant", "paper", "--out", "x.csv", "--hidden"],
            ["follow", "paper", "--from", "x.csv", "--sensors"],
            ["fleet", "paper", "--from", "x.csv", "--sensors"],
        ],
    ),
)
def test_a_pipe_is_refused_without_waiting(usual, tmp_path, command):
    os.mkfifo(pipe := tmp_path / "pipe.csv")
    check_refused(run(*command, pipe, folder=tmp_path), usual)


@pytest.mark.slow
@pytest.mark.parametrize("name", first(1, REFUSED))
def test_a_recording_with_a_hostile_definition_is_refused_in_one_line(usual, sound, tmp_path, name):
    file = rewritten(sound, tmp_path / "hostile.mcap", REFUSED[name])
    done = run("info", file, folder=tmp_path)
    check_refused(done, usual)
    assert "hostile.mcap: /planetary_twin/gearbox_state: " in done.errors


@pytest.mark.slow
@pytest.mark.parametrize("name", first(1, READ))
def test_the_valid_parts_of_a_hostile_recording_are_read(usual, sound, tmp_path, name):
    file = rewritten(sound, tmp_path / "hostile.mcap", READ[name])
    done = run("info", file, folder=tmp_path)
    check(done, usual)
    assert done.code == 0 and "gearbox_state" in done.output


@pytest.mark.slow
@pytest.mark.parametrize("name", first(1, MESSAGES))
def test_a_hostile_message_is_reported_with_its_file_and_topic(usual, sound, tmp_path, name):
    topic, data = MESSAGES[name]
    file = rewritten(sound, tmp_path / "hostile.mcap", messages_of(topic, data))
    done = run("verify", file, folder=tmp_path)
    check(done, usual)
    assert done.code != 0
    assert topic in done.errors + done.output
    assert topic != "run_origin" or "skipped" in done.errors  # and why


@pytest.mark.exhaustive
def test_an_excessive_number_of_topics_is_one_line(usual, tmp_path):
    file = many_channels(tmp_path / "many.mcap")
    done = run("info", file, folder=tmp_path)
    check_refused(done, usual)
    assert "has too many topics: must be at most 2048" in done.errors


COMMANDS = {"info": [], "recover": ["--out"], "verify": [], "export": ["--out"], "spectrum": []}


@pytest.fixture(scope="module")
def imported(sound, tmp_path_factory):
    """What the commands import, is in this process and in its copies."""
    for command, out in COMMANDS.items():
        outs = [*out, str(tmp_path_factory.mktemp(command) / "out")] if out else []
        done = CliRunner().invoke(build_app(), [command, str(sound), *outs])
        assert done.exit_code in (0, 2), done.output  # nothing is to be recovered


@pytest.mark.exhaustive
@pytest.mark.usefixtures("imported")
@pytest.mark.parametrize("command", COMMANDS)
@pytest.mark.parametrize("name", [*REFUSED, *READ, *MESSAGES])
def test_no_command_fails_on_a_hostile_recording(sound, tmp_path, command, name):
    alter = REFUSED.get(name) or READ.get(name) or messages_of(*MESSAGES[name])
    file = rewritten(sound, tmp_path / "hostile.mcap", alter)
    out = [*COMMANDS[command], str(tmp_path / "out")] if COMMANDS[command] else []
    code, text = forked([command, str(file), *out], tmp_path / "text.txt")
    assert code in (0, 1, 2) and "Traceback" not in text, text[-2000:]
    assert "\x1b" not in text


def forked(arguments, path):
    """Exit code and output of a command in a copy of this process."""
    child = os.fork()
    if not child:
        signal.alarm(60)
        with path.open("w", encoding="utf-8") as text:
            os.dup2(text.fileno(), 1)
            os.dup2(text.fileno(), 2)
            sys.argv = ["planetary-twin", *arguments]
            sys.stdout, sys.stderr = text, text
            try:
                main()
            except SystemExit as ended:
                code = ended.code if isinstance(ended.code, int) else int(ended.code is not None)
            except BaseException:
                traceback.print_exc()
                code = 3
            else:
                code = 0
        os._exit(code)
    _, status = os.waitpid(child, 0)
    return os.waitstatus_to_exitcode(status), path.read_text("utf-8")
