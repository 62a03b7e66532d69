"""Damage of the simulated gearbox: its file, and what the intervals add to it."""

from __future__ import annotations

import threading
from collections.abc import Mapping
from copy import deepcopy
from pathlib import Path
from typing import Any

from planetary_twin_py import Scene, Window
from planetary_twin_py.durability.damage_state import DamageState
from planetary_twin_py.durability.parts import part_names
from planetary_twin_py.durability.run_damage import RunDamage
from planetary_twin_py.durability.state_file import StateFile
from planetary_twin_py.scene.thermal import NODES


class SimulatedDamage:
    """
    Damage of the parts of `scene`, continued from the file `path` if one is given.

    The thread of the twin adds intervals; any thread may save. Raises `ValueError` or `OSError` if
    the file is not the damage of this gear set, or cannot be read.
    """

    def __init__(self, scene: Scene, path: Path | None) -> None:
        parts = part_names(scene)
        self._file = None if path is None else StateFile(path, scene, parts)
        self._lock, self._writing = threading.Lock(), threading.Lock()
        self._run = RunDamage(DamageState(parts) if self._file is None else self._file.state)
        self._due: Mapping[str, Mapping[str, Any]] = {}
        self.fault = ""
        """Why the file was not written last time; empty if it was."""

    @property
    def state(self) -> DamageState:
        """Return the damage now."""
        with self._lock:
            return deepcopy(self._run.state)

    def begin(self) -> DamageState:
        """Begin a run at time zero; returns the damage at its start."""
        with self._lock:
            self._run = RunDamage(self._run.state)
        return self.state

    def warmed(self, scene: Scene) -> Scene:
        """Return `scene` with the last temperatures in the file as its start, if it has them."""
        last = self.state.temperatures
        if self._file is None or scene.thermal is None or not last:
            return scene
        return scene.replace(**{"thermal.start": last})

    def add(self, window: Window) -> None:
        """Add an interval."""
        if window.damage is None:
            return
        with self._lock:
            self._run.add(window.damage)
            temperatures = window.temperatures.items()
            self._run.state.temperatures = {n: v for n, v in temperatures if n in NODES}
            self._due = self._run.messages(window.start, window.end)

    def due(self, topic: str) -> Mapping[str, Any] | None:
        """Return the fields of the message of `topic` that is due after the last interval."""
        return self._due.get(topic)

    def replace_part(self, name: str, time: float) -> tuple[str, ...]:
        """Set the damage of a part to 0 at simulated `time` [s]; returns the parts."""
        with self._lock:
            return tuple(entry.part for entry in self._run.replace_part(name, time))

    def save(self) -> Path:
        """Write the file; raises `ValueError` without one, or as `OSError` if it fails."""
        if self._file is None:
            raise ValueError("damage_file = '': must be the path of a file")
        with self._writing:
            try:
                self._file.write(self.state)
            except (ValueError, OSError) as reason:
                self.fault = f"the damage is not saved: {reason}"
                raise
        self.fault = ""
        return self._file.path

    @property
    def has_file(self) -> bool:
        """Whether there is a file to write."""
        return self._file is not None
