"""Damage of the gearboxes of a fleet: a folder with a file for each."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from urllib.parse import quote

import numpy as np
from numpy.typing import NDArray

from ..durability.damage_state import DamageState
from ..durability.state_file import StateFile
from ..following.arrival.stamps import absolute_stamps
from ..following.damage.counter import DamageCounter
from ..following.damage.followed import measured_map, rated_parts
from ..following.damage.remarks import damage_remarks
from ..scene import Scene

Array = NDArray[np.float64]

AT_ONCE = 1024  # readings that are counted together


def file_of(folder: Path, gearbox: str) -> Path:
    """Path of the file of a gearbox; what file names cannot have is written as in addresses."""
    return folder / f"{quote(gearbox, safe=' ()+,=@').replace('.', '%2E')}.json"


class FleetDamage:
    """Continues the damage of some gearboxes.

    Args:
        scene: scene of the type, with its section `durability`.
        folder: folder with the files, which is made if it does not exist.
        gearboxes: names of the gearboxes.
        period: usual time between two rows [s].
        begin: second 0 of the times, from 1970 [s], of a table with dates.

    Raises:
        ValueError, OSError: a file is not the damage of this gear set, or cannot be read.
    """

    def __init__(
        self,
        scene: Scene,
        folder: Path,
        gearboxes: Sequence[str],
        period: float = 1.0,
        begin: float = 0.0,
    ) -> None:
        self._begin = begin
        folder.mkdir(parents=True, exist_ok=True)
        parts = rated_parts(scene)
        self._files = [StateFile(file_of(folder, name), scene, parts) for name in gearboxes]
        states = [file.state for file in self._files]
        self._counter = DamageCounter(scene, measured_map(scene), states, period)
        self._waiting: list[tuple[float, Mapping[str, Array]]] = []

    def add(self, time: float, row: Mapping[str, Array]) -> None:
        """Add a row of every gearbox at its time [s], without impossible readings."""
        self._waiting.append((time, row))
        if len(self._waiting) * len(self._files) >= AT_ONCE:
            self._counted()

    def _counted(self) -> DamageCounter:
        """The counter, after it has counted what waits: many rows cost little more than one."""
        waiting, self._waiting = self._waiting, []
        if waiting:
            stamps = absolute_stamps(np.array([time for time, _ in waiting]), self._begin)
            names = waiting[0][1]
            self._counter.add(
                stamps, {name: np.stack([row[name] for _, row in waiting]) for name in names}
            )
        return self._counter

    def save(self, which: Iterable[int]) -> None:
        """Write the files of some gearboxes.

        Raises `ValueError` if another program has changed one.
        """
        counter = self._counted()
        for n in which:
            self._files[n].write(counter.state(n))

    def of(self, gearbox: int) -> tuple[DamageState, tuple[str, ...]]:
        """The damage of a gearbox, and what it does not contain."""
        counter = self._counted()
        return counter.state(gearbox), tuple(damage_remarks(counter, gearbox))
