"""Services of an active follower."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from rclpy.node import Node

import planetary_twin_py as pt

from ..base.services import serve_triggers
from .live_follower import LiveFollower


class FollowerServices:
    """
    The services `~/reset`, `~/learn`, `~/acknowledge`, `~/save_baseline` and `~/load_baseline`.

    They are services of `node`, whose parameter `baseline` names the file. The response gives the
    file, or the reason of a refusal. `active` returns the live follower, and raises `ValueError`
    if there is none. `acknowledge` acknowledges all events, and returns how many are new to it.
    """

    def __init__(
        self, node: Node, active: Callable[[], LiveFollower], acknowledge: Callable[[], int]
    ) -> None:
        self._node, self._active, self._acknowledged = node, active, acknowledge
        commands = {
            "reset": self._reset,
            "learn": self._learn,
            "acknowledge": self._acknowledge,
            "save_baseline": self._save,
            "load_baseline": self._load,
        }
        serve_triggers(node, commands)

    def _reset(self) -> str:
        self._active().reset()
        return "restarts"

    def _learn(self) -> str:
        self._active().ask(pt.Follower.learn)
        return "baselines of teeth and vibration are learned from now on"

    def _acknowledge(self) -> str:
        return f"{self._acknowledged()} events acknowledged"

    def _save(self) -> str:
        path = self._file()
        self._active().ask(lambda follower: follower.save_baseline(path))
        return str(path)

    def _load(self) -> str:
        path = self._file()
        self._active().ask(lambda follower: follower.load_baseline(path))
        return str(path)

    def _file(self) -> Path:
        name = self._node.get_parameter("baseline").value
        if not name:
            raise ValueError("baseline = '': must be the path of a file")
        return Path(name).expanduser().absolute()
