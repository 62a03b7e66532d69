"""Keeps a twin on this machine unless its user has said otherwise."""

from __future__ import annotations

import os
from pathlib import Path

from ament_index_python.packages import get_package_share_directory

_RANGE, _PROFILE = "ROS_AUTOMATIC_DISCOVERY_RANGE", "FASTRTPS_DEFAULT_PROFILES_FILE"


def stay_on_this_machine() -> None:
    """Limit discovery, and bind sockets to the loopback interface, here and in what is started.

    Limited discovery alone leaves sockets open to every interface. Who sets either variable
    decides for himself.
    """
    if os.environ.setdefault(_RANGE, "LOCALHOST") == "LOCALHOST":
        share = Path(get_package_share_directory("planetary_twin"))
        os.environ.setdefault(_PROFILE, str(share / "config" / "loopback.xml"))
