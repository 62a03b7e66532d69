"""
The nodes' executables: a signal ends them while they load as cleanly as later.

Loading ROS and the model takes a second, in which Python would answer Ctrl-C with a traceback.
"""

from __future__ import annotations

import os
import signal
from importlib import import_module
from types import FrameType


def simulation() -> int:
    """Run the simulation node."""
    return _run("simulation")


def logger() -> int:
    """Run the logger node."""
    return _run("logger")


def replay() -> int:
    """Run the replay node."""
    return _run("replay")


def twin() -> int:
    """Run the simulation and the logger in one process."""
    return _run("composed")


def _run(name: str) -> int:
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, _leave)  # until `run_node` takes them
    return int(import_module(f".{name}", __package__).main())


def _leave(number: int, frame: FrameType | None) -> None:
    # An exception would be shown, and lost, where it falls into a callback of the import system.
    os._exit(0)
