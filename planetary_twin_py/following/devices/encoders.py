"""Two encoders on the input and output members: their whole turns, their speed, and the teeth."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from ..channels.encoders import EncoderFormat, EncoderMessages, EncoderSamples, read_encoders
from ..checks.encoder_speed import EncoderSpeed
from ..checks.sample_check import CountCheck
from ..checks.whole_turns import WholeTurns
from ..input_error import InputError
from ..sensors import Sensors
from ..teeth.baseline_file import SavedBaseline, TeethBaseline
from ..teeth.follower import TeethFollower
from .device import DeviceFollower, DeviceState, FollowedDevice


class EncoderFollower(DeviceFollower):
    """Follows two encoders from the first samples on, which state their format."""

    teeth: TeethFollower | None = None
    """None before the first samples."""
    _loaded: TeethBaseline | None = None  # for samples that have not arrived yet
    _format: EncoderFormat
    _turns: WholeTurns
    _speed: EncoderSpeed

    def add(self, block: EncoderSamples) -> None:
        """Add samples in the order of their arrival."""
        teeth = self.teeth or self._begin(block.format)
        if block.format not in (None, self._format):
            raise InputError(f"encoders: {block.format}: must be {self._format} as before")
        sample, counts = self._turns.add(block.sample, block.counts)
        teeth.add(sample, counts)
        self._speed.add(sample, counts)

    def _begin(self, known: EncoderFormat | None) -> TeethFollower:
        if known is None:
            raise ValueError("encoders: their counts per turn and their period are missing")
        self._format, self._speed = known, EncoderSpeed(*known)
        self._turns = WholeTurns(CountCheck(self.balance.train, *known))
        self.teeth = TeethFollower(self.scene, *known, self.sensors.learning)
        if self._loaded is not None:
            self.teeth.restore(self._loaded)
        return self.teeth

    def judge(self, until: float) -> None:
        """Judge what the encoders show up to a time [s]."""
        if self.teeth is not None:
            self._speed.judge(until, self.balance.turning_between)
            self.teeth.judge(until, self.balance.torque_between)

    def finish(self) -> None:
        """Process the samples that are held back, at the end of a recording."""
        if self.teeth is None:
            return
        if math.isfinite(self.balance.time):
            self._speed.judge(self.balance.time, self.balance.turning_between)
        self.teeth.finish()
        self.teeth.judge(math.inf, self.balance.torque_between)

    def state(self) -> DeviceState:
        """Compliance, changed teeth, and hunting periods."""
        if (teeth := self.teeth) is None:
            return DeviceState()
        counters = {f"encoder_{name}": n for name, n in vars(teeth.counters).items()}
        shown = {"teeth": teeth.teeth, "every_z": teeth.every_z, "cells": teeth.cells}
        return DeviceState(
            teeth.estimates(), teeth.events, counters | {"hunting_periods": teeth.blocks},
            {"teeth": teeth.compared > 0}, shown,
        )  # fmt: skip

    def remarks(self) -> Iterator[str]:
        """Reasons why teeth are judged worse, or not at all."""
        if self.teeth is None:
            return
        yield from self._turns.remarks()
        segments = self.teeth.counters.segments
        if segments > 1:
            yield (
                f"encoders: the count of turns restarted {segments - 1} times; teeth are numbered "
                "from each new start, and baselines are learned again"
            )
        yield from self.teeth.remarks()
        if self.teeth.blocks:
            yield from self._speed.remarks()

    def learn(self) -> None:
        """Forget the baselines of the teeth and learn new ones."""
        self._loaded = None
        if self.teeth is not None:
            self.teeth.learn()

    def saved(self) -> Mapping[str, Any]:
        """Baselines of the teeth."""
        return {"teeth": None if self.teeth is None else self.teeth.saved}

    def restore(self, saved: SavedBaseline) -> None:
        """Use saved baselines of the teeth instead of learning."""
        self._loaded = saved.teeth
        if self.teeth is not None and saved.teeth is not None:
            self.teeth.restore(saved.teeth)


def _read(path: Path, sensors: Sensors, begin: np.datetime64 | None) -> EncoderSamples:
    """Read a table of counts, whose format is that of `sensors`."""
    given = sensors.encoders
    known = EncoderFormat((given.input_counts, given.output_counts), 1.0 / given.rate)
    return read_encoders(path, known.period, begin)._replace(format=known)


DEVICE = FollowedDevice(EncoderMessages, _read, EncoderFollower)
