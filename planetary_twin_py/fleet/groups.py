"""Processes the gearboxes of a table in groups, on this machine or on a cluster."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from ..durability.damage_state import DamageState
from ..following.balance.balances import PARAMETERS
from ..following.sensors import Sensors
from ..scene import Scene
from ..studies.work import Executor, Failure
from ..text.finite import finite
from .fleet import Fleet, FleetEvent
from .fleet_damage import FleetDamage
from .tables import read_fleet

SIZE = 200  # gearboxes of a group: arrays of a day at 1 Hz take 0.5 GB

Group = tuple[str, ...]
"""Names of the gearboxes of a group."""


@dataclass(frozen=True)
class GearboxResult:
    """Estimates of one gearbox at the end of a table."""

    gearbox: str
    readings: int
    """Number of balances that were used."""
    estimates: dict[str, tuple[float, float, float]]
    """Value and 95 % interval in SI by parameter; NaN where the readings do not determine it."""
    events: tuple[FleetEvent, ...]
    """Steps of its loss; `FleetEvent.gearbox` is its index in the group."""
    fits: bool
    """Whether its readings fit the scene, see `Fleet.fits`."""
    fault: str
    """Channel, value and correction of readings that contradict the scene; empty without."""
    remarks: tuple[str, ...]
    """See `Fleet.remarks`."""
    scatter: tuple[float, float]
    """Measured scatter of its balance, and what the sensors explain of it [N m]; NaN if unknown."""
    scatters: bool
    """Whether the sensors do not explain the scatter, see `FleetScatter.excessive`."""
    smallest_step: float
    """See `FleetScatter.step`."""
    missing: tuple[int, float]
    """Number of times of the table without both torques and the speed, and the first of them [s].
    """
    damage: DamageState | None = None
    """Damage so far; None if it is not counted, or readings contradict the scene."""
    damage_remarks: tuple[str, ...] = ()
    """What the damage does not contain."""

    @property
    def is_judged(self) -> bool:
        """Whether a step could be found."""
        return not self.fault and self.readings > 0

    def figures(self) -> dict[str, Any]:
        """The result for JSON; None in place of what is unknown."""
        damage = {} if self.damage is None else {"damage": self.damage.figures()}
        return damage | {
            "readings": self.readings,
            "missing": self.missing[0],
            "first_missing": finite(self.missing[1]),
            "fits": self.fits,
            "fault": self.fault or None,
            "remarks": self.remarks,
            "scatter": finite(self.scatter[0]),
            "stated_scatter": finite(self.scatter[1]),
            "scatters": self.scatters,
            "smallest_step": finite(self.smallest_step),
            "estimates": {
                name: [finite(value) for value in values] for name, values in self.estimates.items()
            },
            "events": [
                {name: finite(getattr(event, name)) for name in ("since", "found", "size", "share")}
                for event in self.events
            ],
        }


@dataclass(frozen=True)
class FollowGroup:
    """Processes one group; it is pickled for other processes, each of which reads the table.

    Args:
        path: path of the table, the same on all workers.
        scene: scene of the type of gearbox.
        count: number of gearboxes of the whole fleet, which sets the limit of an alarm.
        sensors: accuracy of the torque sensors.
        durability: folder with the damage of each gearbox, which the rows continue; the same on all
            workers. None: damage is not counted.
    """

    path: Path
    scene: Scene
    count: int
    sensors: Sensors = field(default_factory=Sensors)
    durability: Path | None = None

    def __call__(self, group: Group) -> tuple[GearboxResult, ...] | Failure:
        """Process a group from the first to the last row of the table."""
        try:
            return self._follow(group)
        except (ValueError, ArithmeticError, OSError) as reason:
            return Failure(f"gearboxes {group[0]} to {group[-1]}: {reason}")

    def _follow(self, group: Group) -> tuple[GearboxResult, ...]:
        table = read_fleet(self.path, group)
        if len(table.time) < 2:
            raise ValueError(f"{self.path}: must have at least two times")
        period = float(np.median(np.diff(table.time)))
        counted = None
        if self.durability is not None:
            counted = FleetDamage(self.scene, self.durability, group, period, table.begin)
        fleet = Fleet(self.scene, len(group), period, self.sensors, self.count, counted)
        for row, time in enumerate(table.time):
            fleet.add(float(time), {name: values[row] for name, values in table.columns.items()})
        fleet.finish()
        if counted is not None:
            counted.save(n for n in range(len(group)) if n not in fleet.faults)
        scatter = fleet.scatter
        estimates = {name: fleet.estimate(name) for name in PARAMETERS[:4]}
        return tuple(
            GearboxResult(
                name,
                int(fleet.readings[n]),
                {
                    key: (float(estimate.value[n]), float(estimate.low[n]), float(estimate.high[n]))
                    for key, estimate in estimates.items()
                },
                tuple(event for event in fleet.events if event.gearbox == n),
                bool(fleet.fits[n]),
                fleet.faults.get(n, ""),
                (*table.remarks[n], *fleet.remarks(n)),
                (float(scatter.measured[n]), float(scatter.stated[n])),
                bool(scatter.excessive[n]),
                float(scatter.step[n]),
                (int(fleet.missing[n]), float(fleet.first_missing[n])),
                *((None, ()) if counted is None or n in fleet.faults else counted.of(n)),
            )
            for n, name in enumerate(group)
        )


def follow_groups(
    work: FollowGroup,
    gearboxes: Sequence[str],
    executor: Executor,
    report: Callable[[int], None] = lambda done: None,
    size: int = SIZE,
) -> list[GearboxResult]:
    """Process all gearboxes of a table in groups; return a result for each, in their order.

    `report` is called with the number of gearboxes that are done since the last call. Raises
    `ValueError` if a group cannot be processed.
    """
    groups = [tuple(gearboxes[n : n + size]) for n in range(0, len(gearboxes), size)]
    results: dict[Group, tuple[GearboxResult, ...]] = {}
    for group, result in executor.run(work, groups):
        if isinstance(result, Failure):
            raise ValueError(result.reason)
        results[group] = result
        report(len(group))
    return [gearbox_result for group in groups for gearbox_result in results[group]]
