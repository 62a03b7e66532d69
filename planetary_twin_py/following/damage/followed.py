"""Damage of a gearbox that is followed: its file, and the readings that continue it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import lru_cache
from itertools import groupby
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...durability.damage_state import DamageState
from ...durability.parts import part_names, teeth_of
from ...durability.state_file import StateFile
from ...lifetime.damage_map import DamageMap, make_damage_map, range_of
from ...scene import Scene, SceneError
from ..checks.reading_check import ReadingCheck
from ..loss_map import COLDEST, HOTTEST
from ..sensors import Sensors
from ..train import followed_train
from .counter import DamageCounter
from .remarks import damage_remarks
from .rows import TORQUE_SD

Array = NDArray[np.float64]

AT_ONCE = 1024  # blocks of readings that are counted together


class _Block(NamedTuple):
    """Readings that are not counted yet."""

    time: Array
    columns: Mapping[str, Array]
    sender: str

    def kind(self) -> tuple[str, ...]:
        """What blocks have in common that are one table."""
        return (self.sender, *self.columns)


def rated_parts(scene: Scene) -> tuple[str, ...]:
    """Names of the parts of a scene that collect damage.

    Args:
        scene: scene of the gearbox.

    Raises:
        SceneError: it has no section `durability`.
    """
    parts = part_names(scene)
    if not parts:
        raise SceneError("durability: missing: damage is counted by materials and bearings")
    return parts


def measured_map(scene: Scene) -> DamageMap:
    """Map of damage for readings: at every temperature of the oil, as gearboxes start cold.

    Args:
        scene: scene of the gearbox, with one input and its section `durability`.

    Returns:
        The map, shared by all callers with the same scene.
    """
    return _map_of(scene.model_dump_json())


@lru_cache(maxsize=4)
def _map_of(text: str) -> DamageMap:
    scene = Scene.model_validate_json(text)
    return make_damage_map(scene, range_of(scene)._replace(temperature=(COLDEST, HOTTEST)))


class FollowedDamage:
    """Continues the damage of a gearbox by its readings.

    Args:
        scene: scene of the gearbox, with one input and its section `durability`.
        sensors: accuracy of the sensors.
        path: path of its file, which need not exist.

    Raises:
        ValueError, OSError: the file is not the damage of this gear set, or cannot be read.
    """

    def __init__(self, scene: Scene, sensors: Sensors, path: Path) -> None:
        self._file = StateFile(path, scene, rated_parts(scene))
        self._counter = DamageCounter(scene, measured_map(scene), [self._file.state])
        train = followed_train(scene)
        self._check = ReadingCheck(train, sensors)
        self._teeth = np.array([teeth_of(part, train.teeth) for part in self._file.state.parts])
        self._waiting: list[_Block] = []

    @property
    def path(self) -> Path:
        """Path of the file."""
        return self._file.path

    @property
    def state(self) -> DamageState:
        """The damage so far."""
        return self._counted().state()

    @property
    def teeth(self) -> NDArray[np.int64]:
        """Teeth of each part; 1 for bearings, (parts,)."""
        return self._teeth

    @property
    def rates(self) -> Array:
        """Rates of damage at the last reading [1/s], (parts,); NaN before."""
        rates: Array = self._counted().since_start.rates[0]
        return rates

    def add(
        self, time: Array, columns: Mapping[str, Array], torque_sd: Array | None, sender: str
    ) -> None:
        """Add readings of a sender.

        Args:
            time: stamps [s], (n,); NaN where one is not set.
            columns: readings in SI by channel, (n,) each; NaN where one is missing.
            torque_sd: standard deviations of the input torque within each [N m], (n,).
            sender: name of the sender.
        """
        given = dict(columns) if torque_sd is None else {**columns, TORQUE_SD: torque_sd}
        self._waiting.append(_Block(time, given, sender))
        if len(self._waiting) == AT_ONCE:
            self._counted()

    def _counted(self) -> DamageCounter:
        """The counter, after it has counted what waits: many readings cost little more than one."""
        waiting, self._waiting = self._waiting, []
        for (sender, *names), some in groupby(waiting, _Block.kind):
            blocks = list(some)
            time = np.concatenate([block.time for block in blocks])
            rows = {
                name: np.concatenate([block.columns[name] for block in blocks])[:, None]
                for name in names
            }
            scatter = {name: rows.pop(name) for name in names if name == TORQUE_SD}
            self._counter.add(time, self._check.judge(time, rows, sender) | scatter)
        return self._counter

    def replace_part(self, name: str) -> tuple[str, ...]:
        """Set the damage of a part to 0, and note it.

        Args:
            name: a part, or a gear for its flanks and root.

        Returns:
            The parts.

        Raises:
            ValueError: there is no such part.
        """
        return tuple(entry.part for entry in self._counted().replace_part(name))

    def save(self) -> None:
        """Write the file.

        Raises:
            ValueError, OSError: it was changed by another program, or cannot be written.
        """
        self._file.write(self.state)

    def remarks(self) -> Iterator[str]:
        """What the sums do not contain."""
        yield from damage_remarks(self._counted())
