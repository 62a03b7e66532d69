"""Tries the blocks of a page as its reader would: in a shell, in one namespace, in one folder."""

import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import yaml
from docs.blocks import Block, blocks, shows
from domains import private_domain

import planetary_twin_py as pt

TIMEOUT = 1200.0  # [s] longest time of a command; most take a few seconds
STARTS = 600.0  # [s] for the first output of a background command
ENDS = 120.0  # [s] for its end


@contextmanager
def readers_environment() -> Iterator[dict[str, str]]:
    """The environment of a reader who has activated .venv, on a machine without a display."""
    outside = {key: value for key, value in os.environ.items() if key != "DISPLAY"}
    path = f"{Path(sys.executable).parent}:{os.environ['PATH']}"
    with private_domain() as number:
        own = {"PATH": path, "MPLBACKEND": "Agg", "COLUMNS": "200", "ROS_DOMAIN_ID": str(number)}
        yield outside | own | {"PYTHONUNBUFFERED": "1"}


def changes_code(page):
    return any(block.language == "diff" for block in blocks(page))


def tried(page):
    return [block for block in blocks(page) if block.word("not-run") is None]


def try_block(block: Block, folder, environment, namespace, behind):
    if block.word("file"):
        (folder / block.word("file")).write_text(block.text)
    elif block.language == "python":
        exec(compile("\n" * block.line + block.text, str(block), "exec"), namespace)
    if block.language == "yaml":
        check_yaml(block)
    for command, output in block.session if block.language == "console" else ():
        if "background" in block.words:
            behind.append(start(command, folder, environment))
            continue
        done = subprocess.run(
            command, shell=True, cwd=folder, env=environment, capture_output=True, text=True,
            timeout=TIMEOUT,
        )  # fmt: skip
        assert done.returncode == 0, f"{block}: {command}\n{done.stdout}{done.stderr}"
        assert shows(output, done.stdout + done.stderr), (
            f"{block}: {command}\nshows\n{output}but prints\n{done.stdout}{done.stderr}"
        )


def check_yaml(block):
    """A scene, or a part of one, is a valid scene; parameters of nodes are valid YAML."""
    content = yaml.safe_load(block.text)
    if set(content) <= {"base", *pt.Scene.model_fields}:
        whole = "base" in content or "gearset" in content
        pt.parse_scene(block.text if whole else "base: paper\n" + block.text)


def start(command, folder, environment):
    """Start a background command, and wait for its first output."""
    log = folder / "background.log"
    process = subprocess.Popen(
        f"exec {command}", shell=True, cwd=folder, env=environment,
        stdout=log.open("w"), stderr=subprocess.STDOUT,
    )  # fmt: skip
    deadline = time.monotonic() + STARTS
    while not log.stat().st_size and process.poll() is None and time.monotonic() < deadline:
        time.sleep(0.05)
    assert process.poll() is None and log.stat().st_size, f"{command}\n{log.read_text()}"
    return process


def end(process):
    """Ctrl-C; returns the final output of the process."""
    if process.poll() is None:
        process.send_signal(signal.SIGINT)
    return process.wait(ENDS)
