"""Shuts ROS down; a signal may do so at the same moment."""

from __future__ import annotations

import rclpy
from rclpy.context import Context


def shut_down(context: Context | None = None) -> None:
    """
    Shut `context`, or the default one of rclpy, down unless it is already shut down.

    Raises `RuntimeError` if rcl fails and the context is still valid.
    """
    try:
        rclpy.try_shutdown(context=context)
    except RuntimeError:
        # rclpy's signal thread may shut down between the check of rclpy and its call of rcl.
        if rclpy.ok(context=context):
            raise
