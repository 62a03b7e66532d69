"""Keeps a twin on this machine unless its user has said otherwise."""

from __future__ import annotations

import os


def stay_on_this_machine() -> None:
    """Limit discovery, here and in what is started."""
    os.environ.setdefault("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")
