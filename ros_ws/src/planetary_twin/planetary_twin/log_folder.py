"""The folder of the log files of ROS where the process has no home folder."""

from __future__ import annotations

import os
import tempfile

_CHOSEN = "ROS_LOG_DIR", "ROS_HOME"


def choose_log_folder() -> None:
    """
    Log below the folder for temporary files if no folder is chosen and there is no home folder.

    By default rcl logs into ~/.ros/log, and fails without HOME, as in services and containers.
    """
    chosen = any(os.environ.get(name) for name in _CHOSEN)
    if not chosen and not os.access(os.environ.get("HOME", ""), os.W_OK):
        os.environ["ROS_LOG_DIR"] = os.path.join(tempfile.gettempdir(), f"ros_log_{os.getuid()}")
