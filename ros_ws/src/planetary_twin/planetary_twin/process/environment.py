"""The environment of a process with nodes: the folder of log files, threads of NumPy."""

from __future__ import annotations

import os
import tempfile
from collections.abc import MutableMapping

_CHOSEN = "ROS_LOG_DIR", "ROS_HOME"


def choose_log_folder() -> None:
    """
    Log below the folder for temporary files if no folder is chosen and there is no home folder.

    By default rcl logs into ~/.ros/log, and fails without HOME, as in services and containers.
    """
    chosen = any(os.environ.get(name) for name in _CHOSEN)
    if not chosen and not os.access(os.environ.get("HOME", ""), os.W_OK):
        os.environ["ROS_LOG_DIR"] = os.path.join(tempfile.gettempdir(), f"ros_log_{os.getuid()}")


def use_one_thread(environment: MutableMapping[str, str]) -> None:
    """
    Set the number of threads in the environment of a process that has not loaded NumPy.

    The matrices of a node are small: more threads would use a second core for waiting only (a
    follower with vibration at 20 kHz takes 25 % of a core instead of 11 %). A value set by the
    user is kept.
    """
    environment.setdefault("OPENBLAS_NUM_THREADS", "1")
