"""The outcome of a run: counted in the finished file, as a table or as JSON values."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from rich.console import Console
from rich.table import Table

from planetary_twin_py.recording.container.records import sections_of
from planetary_twin_py.recording.ros2.decode import Topics
from planetary_twin_py.recording.ros2.topics import STATE
from planetary_twin_py.recording.runs.contents import TopicInfo
from planetary_twin_py.recording.runs.info import read_info


@dataclass
class Sums:
    """Sums over states; `add` takes constant memory for any number of them."""

    states: int = 0
    duration: float = 0.0  # [s] simulated
    lost: float = 0.0  # [J]
    put_in: float = 0.0  # [J] by the machines that drive
    lowest_rate: float = math.inf  # [Hz] of the waveform
    highest_rate: float = -math.inf  # [Hz]

    def add(self, field: Callable[[str], Any]) -> None:
        """Add states; `field` returns the values of a field, of one state or an array of many."""
        interval, rate = np.asarray(field("interval")), field("sample_rate")
        self.states += interval.size
        self.duration += float(np.sum(interval))
        self.lost += float(np.sum(field("power_loss") * interval))
        self.put_in += float(np.sum(driving_power(field) * interval))
        self.lowest_rate = min(self.lowest_rate, float(np.min(rate)))
        self.highest_rate = max(self.highest_rate, float(np.max(rate)))


def driving_power(field: Callable[[str], Any]) -> Any:
    """
    Return the power of the machines that drive in the interval of a state [W].

    Each machine's power has the direction of its mean over the interval. 0 where none drives but
    for rounding errors, which a state shows by its efficiency.
    """
    second = np.nan_to_num(field("second_input_torque") * field("second_input_speed"))
    powers = field("input_power") - second, second, -field("output_power")
    total = sum(np.maximum(power, 0.0) for power in powers)
    return np.where(np.isfinite(field("efficiency")), total, 0.0)


def sums_of(files: Sequence[Path]) -> Sums:
    """Return the sums over all states in recorded `files`, section by section."""
    sums = Sums()
    for file in files:
        topics = Topics(file, lambda topic: topic.endswith(f"/{STATE}"))
        for section in sections_of(file, []):
            messages: dict[int, list[bytes]] = {}
            for record in section.records:
                if topics.of(record):
                    messages.setdefault(record.channel_id, []).append(record.data)
            for channel, data in messages.items():
                for rows in topics.by_channel[channel].arrays(data):
                    sums.add(rows.__getitem__)
    return sums


@dataclass(frozen=True)
class Tally:
    """Messages of one topic: published, recorded, and missing between two recorded ones."""

    type: str
    published: int
    recorded: int
    missed: int

    @property
    def lost(self) -> int:
        """Return the number of messages published but not in the file."""
        return self.published - self.recorded


@dataclass(frozen=True)
class Outcome:
    """A finished run; it has several `files` if the logger was asked to split or to stop."""

    files: Sequence[Path]
    stopped: bool  # whether the logger was stopped during the run
    topics: Mapping[str, Tally]
    duration: float  # [s] simulated
    power_loss: float  # [W] mean; NaN without a state
    efficiency: float  # [-] over the whole run; NaN if no machine drives
    real_time_factor: float
    overruns: int
    tolerance: float  # in force at the end
    tolerance_choice: str
    sample_rates: tuple[float, float]  # [Hz] of the waveform, lowest and highest; NaN without

    def losses(self) -> dict[str, int]:
        """Return the number of messages by topic that are missing in the file."""
        lost = {
            name: tally.missed if self.stopped else tally.lost
            for name, tally in self.topics.items()
        }
        return {name: count for name, count in lost.items() if count}

    def figures(self) -> dict[str, Any]:
        """Return the values for `--json`."""
        topics = {
            name: {
                "type": tally.type,
                "published": tally.published,
                "recorded": tally.recorded,
                "lost": tally.lost,
            }
            for name, tally in self.topics.items()
        }
        return {
            "topics": topics,
            "duration_s": self.duration,
            "real_time_factor": self.real_time_factor,
            "overruns": self.overruns,
            "tolerance": None if np.isnan(self.tolerance) else self.tolerance,
            "sample_rates_hz": None if np.isnan(self.sample_rates[0]) else self.sample_rates,
            "mean_power_loss_w": None if np.isnan(self.power_loss) else self.power_loss,
            "efficiency": None if np.isnan(self.efficiency) else self.efficiency,
            "file": str(self.files[0]),
        }


def read_outcome(
    folders: Sequence[Path],
    published: Mapping[str, int],
    figures: Mapping[str, str],
    stopped: bool,
    summed: Sums,
) -> Outcome:
    """
    Compare the recordings in `folders` with the number of messages `published` by topic.

    There are several folders if the logger was `stopped` and started again. `figures` are the
    values of the simulation's last report, `summed` the sums over the states that were received
    during the run: if any recorded one is not among them, all are read again.
    """
    info = read_info(*folders)
    recorded = sum(t.recorded for name, t in info.topics.items() if name.endswith(f"/{STATE}"))
    sums = summed if summed.states == recorded else sums_of(info.files)
    return Outcome(
        files=info.files,
        stopped=stopped,
        topics={name: _tally(topic, published.get(name)) for name, topic in info.topics.items()},
        duration=sums.duration,
        power_loss=sums.lost / sums.duration if sums.states else float("nan"),
        efficiency=1.0 - sums.lost / sums.put_in if sums.put_in > 0.0 else float("nan"),
        real_time_factor=float(figures.get("real_time_factor_mean", "nan")),
        overruns=int(figures.get("overruns", 0)),
        tolerance=float(figures.get("tolerance", "nan")),
        tolerance_choice=figures.get("tolerance_choice", "unknown"),
        sample_rates=(
            (sums.lowest_rate, sums.highest_rate) if sums.states else (float("nan"), float("nan"))
        ),
    )


def _tally(topic: TopicInfo, published: int | None) -> Tally:
    missed = (topic.lost or 0) - topic.before
    # With other publishers, the twin's counter is too low: use the sequence numbers.
    total = topic.recorded + missed
    if published is not None and published >= topic.recorded:
        total = published
    return Tally(topic.type, total, topic.recorded, missed)


def print_outcome(console: Console, outcome: Outcome) -> None:
    """Print a short table, and the command that shows the recording."""
    table = Table(box=None, pad_edge=False)
    table.add_column("topic")
    for title in ("published", "recorded", "lost"):
        table.add_column(title, justify="right")
    for name, tally in sorted(outcome.topics.items()):
        counts = (tally.published, tally.recorded, tally.lost)
        table.add_row(name, *map(str, counts), style="red" if tally.lost else None)
    console.print(table)
    rows = {
        "gearbox time": f"{outcome.duration:.2f} s",
        "real-time factor": f"{outcome.real_time_factor:.4f}, {outcome.overruns} overruns",
        "tolerance": f"{outcome.tolerance:g}, {outcome.tolerance_choice}",
        "waveform": _waveform(*outcome.sample_rates),
        "mean power loss": f"{outcome.power_loss:.2f} W",
        "efficiency": _efficiency(outcome.efficiency),
        "recording": _places(outcome.files),
        "view it": f"planetary-twin view {outcome.files[0].parent}",
    }
    missed = sum(tally.missed for tally in outcome.topics.values())
    ends = sum(tally.lost for tally in outcome.topics.values()) - missed
    if missed or ends:
        rows["lost"] = (
            f"{missed} between recorded messages, {ends} at an end or while the logger was stopped"
        )
    console.print()
    for name, value in rows.items():
        console.print(f"{name:17} {value}", highlight=False, soft_wrap=True)


def _efficiency(value: float) -> str:
    return f"{value:.3%}" if np.isfinite(value) else "undefined: no machine puts power in"


def _places(files: Sequence[Path]) -> str:
    if len(files) == 1:
        return str(files[0])
    folders = dict.fromkeys(str(file.parent) for file in files)
    return f"{' and '.join(folders)}: {len(files)} files"


def _waveform(lowest: float, highest: float) -> str:
    if lowest == highest:
        return f"{highest:g} Hz"
    return f"{highest:g} Hz, reduced to {lowest:g} at times on a busy machine"
