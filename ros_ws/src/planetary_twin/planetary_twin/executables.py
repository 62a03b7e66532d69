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


def run(module: str) -> int:
    """Run the `main` of a module of this package, such as `simulation.node`."""
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, _exit)  # until `run_node` installs its handlers
    use_one_thread(os.environ)
    return int(import_module(f".{module}", __package__).main())


def _exit(number: int, frame: FrameType | None) -> None:
    # An exception inside a callback of the import system would be printed and discarded.
    os._exit(0)
