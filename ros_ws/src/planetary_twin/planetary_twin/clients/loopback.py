"""Confines a twin to this machine unless the environment sets a discovery range."""

from __future__ import annotations

import os
from pathlib import Path

from ament_index_python import get_package_share_directory

_RANGE = "ROS_AUTOMATIC_DISCOVERY_RANGE"
_PROFILE = "FASTRTPS_DEFAULT_PROFILES_FILE"
_POLICIES = "RMW_FASTRTPS_USE_QOS_FROM_XML"  # "1": use the memory policies of the profile
_MIDDLEWARE = "RMW_IMPLEMENTATION"


def stay_on_this_machine() -> None:
    """
    Bind the sockets of this process and its children to the loopback interface.

    If the environment sets a Fast DDS profile or another middleware, which binds the sockets, only
    the discovery is limited.
    """
    if _RANGE in os.environ:
        return
    if _PROFILE in os.environ or "fastrtps" not in os.environ.get(_MIDDLEWARE, "rmw_fastrtps_cpp"):
        os.environ[_RANGE] = "LOCALHOST"
        return
    os.environ[_RANGE] = "SYSTEM_DEFAULT"
    os.environ[_PROFILE] = str(loopback_profile())
    os.environ[_POLICIES] = "1"


def loopback_profile() -> Path:
    """Return the path of the Fast DDS profile that binds to the loopback interface only."""
    return Path(get_package_share_directory("planetary_twin")) / "config" / "loopback.xml"
