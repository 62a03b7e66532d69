"""The follower and the logger in one process."""

from __future__ import annotations

import sys

from .base.spin import run_nodes
from .follower.node import Follower
from .logger.node import Logger


def main(args: list[str] | None = None) -> int:
    """Run both nodes until a signal."""
    return run_nodes({"logger": Logger, "follower": Follower}, args)


if __name__ == "__main__":
    sys.exit(main())
