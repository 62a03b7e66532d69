"""
The executables of the nodes, which a signal also ends cleanly while they load.

Loading ROS and the model takes a second, during which Ctrl-C would otherwise print a traceback.
"""

from __future__ import annotations

import os
import signal
from importlib import import_module
from types import FrameType

from .process.environment import use_one_thread


def simulation() -> int:
    """Run the simulation node."""
    return _run("simulation.node")


def logger() -> int:
    """Run the logger node."""
    return _run("logger.node")


def replay() -> int:
    """Run the replay node."""
    return _run("replay.node")


def follower() -> int:
    """Run the follower node."""
    return _run("follower.node")


def plant() -> int:
    """Run the plant node."""
    return _run("plant.node")


def twin() -> int:
    """Run the simulation and the logger in one process."""
    return _run("twin")


def recorded_follower() -> int:
    """Run the follower and the logger in one process."""
    return _run("recorded_follower")


def _run(name: str) -> int:
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, _exit)  # until `run_node` installs its handlers
    use_one_thread(os.environ)
    return int(import_module(f".{name}", __package__).main())


def _exit(number: int, frame: FrameType | None) -> None:
    # An exception inside a callback of the import system would be printed and discarded.
    os._exit(0)
