"""The simulation and the logger in one process."""

from __future__ import annotations

import sys

from .logger import Logger
from .managed import run_nodes
from .simulation import Simulation


def main(args: list[str] | None = None) -> int:
    """Run both nodes until a signal; the logger starts first, so that it misses nothing."""
    return run_nodes({"logger": Logger, "simulation": Simulation}, args)


if __name__ == "__main__":
    sys.exit(main())
