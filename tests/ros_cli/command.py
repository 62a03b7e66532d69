"""Runs `ros2` as a user does, and reads what it prints."""

import os
import signal
import subprocess
import time
from pathlib import Path
from typing import Any

import yaml


class Ros2:
    """`ros2` in `folder`, on `domain`, confined to this machine."""

    def __init__(self, domain: int, folder: Path) -> None:
        self.folder = folder
        self.started: list[subprocess.Popen[str]] = []
        # As a user has it, shared memory included.
        own = ("FASTRTPS_DEFAULT_PROFILES_FILE", "RMW_FASTRTPS_USE_QOS_FROM_XML")
        given = {k: v for k, v in os.environ.items() if k not in own}
        self._environment = {
            **given,
            "ROS_DOMAIN_ID": str(domain),
            "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST",
        }

    def __call__(self, *arguments: str) -> str:
        """All that a command prints."""
        return subprocess.run(
            ["ros2", *arguments],
            cwd=self.folder,
            env=self._environment,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            timeout=120,
        ).stdout

    def start(self, *arguments: str) -> subprocess.Popen[str]:
        """A command that goes on."""
        with self._output(len(self.started)).open("w") as output:
            process = subprocess.Popen(
                ["ros2", *arguments],
                cwd=self.folder,
                env=self._environment,
                stdout=output,
                stderr=output,
                text=True,
                start_new_session=True,
            )
        self.started.append(process)
        return process

    def interrupt(self, process: subprocess.Popen[str]) -> int:
        """End it as Ctrl-C does, which reaches all that it has started; returns the exit code."""
        if process.poll() is None:
            os.killpg(process.pid, signal.SIGINT)
        return process.wait(120)

    def output(self, process: subprocess.Popen[str]) -> str:
        """What a command that goes on has printed so far."""
        return self._output(self.started.index(process)).read_text(encoding="utf-8")

    def _output(self, number: int) -> Path:
        return self.folder / f"output_{number}"

    def until(self, words: str, *arguments: str) -> str:
        """Repeat a command until it prints `words`; fails the test where it does not in time."""
        deadline = time.monotonic() + 120.0
        while words not in (printed := self(*arguments)):
            assert time.monotonic() < deadline, printed
        return printed

    def echo(self, topic: str, *options: str) -> Any:
        """The next message of a topic."""
        printed = self("topic", "echo", "--once", "--no-lost-messages", topic, *options)
        return next(iter(yaml.safe_load_all(printed)))

    def value(self, node: str, parameter: str) -> str:
        """A parameter as `ros2` shows it."""
        return self("param", "get", node, parameter).partition(": ")[2].strip()
