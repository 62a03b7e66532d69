"""Keeps a twin on this machine unless its user has said otherwise."""

from __future__ import annotations

import os
from pathlib import Path

from ament_index_python import get_package_share_directory

_RANGE = "ROS_AUTOMATIC_DISCOVERY_RANGE"
_PROFILE = "FASTRTPS_DEFAULT_PROFILES_FILE"
_MIDDLEWARE = "RMW_IMPLEMENTATION"


def stay_on_this_machine() -> None:
    """
    Open no socket to a network, here and in what is started.

    Where the environment brings a profile or another middleware of its own, only discovery is
    limited: sockets are then theirs to bind.
    """
    if _RANGE in os.environ:
        return
    if _PROFILE in os.environ or "fastrtps" not in os.environ.get(_MIDDLEWARE, "rmw_fastrtps_cpp"):
        os.environ[_RANGE] = "LOCALHOST"
        return
    os.environ[_RANGE] = "SYSTEM_DEFAULT"
    os.environ[_PROFILE] = str(loopback_profile())


def loopback_profile() -> Path:
    """Profile of Fast DDS that binds to the loopback interface alone."""
    return Path(get_package_share_directory("planetary_twin")) / "config" / "loopback.xml"
