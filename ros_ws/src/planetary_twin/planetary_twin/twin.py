"""The simulation and the logger in one process."""

from __future__ import annotations

import sys
from functools import partial

from .base.spin import run_nodes
from .logger.node import Logger
from .simulation.node import Simulation


def main(args: list[str] | None = None) -> int:
    """Run both nodes until a signal; the simulation waits for the subscriptions of the logger."""
    return run_nodes(
        {"logger": Logger, "simulation": partial(Simulation, {"wait_for": "logger"})}, args
    )


if __name__ == "__main__":
    sys.exit(main())
