"""The nodes' executables: a signal ends them while they load as cleanly as later.

Loading ROS and the model takes a second, in which Python would answer Ctrl-C with a traceback.
"""

from __future__ import annotations

from importlib import import_module

from .signals import SIGNALS


def simulation() -> int:
    """The simulation node."""
    return _run("simulation")


def logger() -> int:
    """The logger node."""
    return _run("logger")


def replay() -> int:
    """The replay node."""
    return _run("replay")


def twin() -> int:
    """The simulation and the logger in one process."""
    return _run("composed")


def _run(name: str) -> int:
    SIGNALS.listen()
    try:
        with SIGNALS.interrupting():
            main = import_module(f".{name}", __package__).main
    except KeyboardInterrupt:
        SIGNALS.ignore()
        return 0
    return int(main())
