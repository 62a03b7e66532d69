"""Services of an active follower."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from rclpy.node import Node

import planetary_twin_py as pt

from ..base.services import serve_triggers
from .live_follower import LiveFollower


def serve_follower(
    node: Node, active: Callable[[], LiveFollower], acknowledge: Callable[[], int]
) -> None:
    """
    Create the services `~/reset`, `~/learn`, `~/acknowledge` and those of baselines of `node`.

    Its parameter `baseline` names their file, which the response of `~/save_baseline` and
    `~/load_baseline` gives. `active` returns the live follower, and raises `ValueError` if there
    is none. `acknowledge` acknowledges all events, and returns how many are new to it.
    """

    def reset() -> str:
        active().reset()
        return "restarts"

    def learn() -> str:
        active().ask(pt.Follower.learn)
        return "baselines of teeth and vibration are learned from now on"

    def with_file(action: Callable[[pt.Follower, Path], None]) -> str:
        name = node.get_parameter("baseline").value
        if not name:
            raise ValueError("baseline = '': must be the path of a file")
        path = Path(name).expanduser().absolute()
        active().ask(lambda follower: action(follower, path))
        return str(path)

    commands = {
        "reset": reset,
        "learn": learn,
        "acknowledge": lambda: f"{acknowledge()} events acknowledged",
        "save_baseline": lambda: with_file(pt.Follower.save_baseline),
        "load_baseline": lambda: with_file(pt.Follower.load_baseline),
    }
    serve_triggers(node, commands)
