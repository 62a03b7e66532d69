"""Plays the cues of a tape at their instants, in a thread of its own."""

from __future__ import annotations

import threading
import time
from collections.abc import Iterator
from itertools import chain
from typing import Protocol

from planetary_twin_py.recording.tape import Cue

_POLL = 0.05  # [s]


class Stage(Protocol):
    """Where cues are played; called in the player's thread."""

    def ready(self) -> bool:
        """Whether the first cue may come."""

    def begin(self) -> None:
        """The first cue comes next."""

    def play(self, cue: Cue) -> None:
        """The instant of `cue` is now."""

    def ended(self) -> None:
        """There is no further cue."""

    def stopped(self, defect: Exception) -> None:
        """The thread ends because of `defect`."""


class Player:
    """Plays `rate_factor` recorded seconds per second, to absolute deadlines on the steady clock.

    A cue that is late is played at once and none is left out: the tape catches up by itself.
    """

    def __init__(self, cues: Iterator[Cue], rate_factor: float, stage: Stage) -> None:
        self._cues = cues
        self._rate_factor = rate_factor
        self._stage = stage
        self._begun = False
        self._stop = threading.Event()
        self._thread: threading.Thread | None = None
        self.lateness = 0.0
        """The longest that a cue came after its instant [s]."""

    def start(self) -> None:
        """Begin as soon as the stage is ready, or go on where `stop` left off."""
        self._stop.clear()
        self._thread = threading.Thread(target=self._run, name="tape", daemon=True)
        self._thread.start()

    def stop(self) -> None:
        """Hold before the next cue."""
        self._stop.set()
        if self._thread is not None:
            self._thread.join()

    def _run(self) -> None:
        try:
            while not self._stage.ready():
                if self._stop.wait(_POLL):
                    return
            if not self._begun:
                self._begun = True
                self._stage.begin()
            if self._play():
                self._stage.ended()
        except Exception as defect:
            self._stage.stopped(defect)

    def _play(self) -> bool:
        """Play to the end of the tape; false if stopped before."""
        origin: float | None = None
        for cue in self._cues:
            due = cue.time * 1e-9 / self._rate_factor
            if origin is None:
                origin = time.monotonic() - due
            remaining = origin + due - time.monotonic()
            # Waiting on the event, not sleeping: a signal need not wait for a gap in the tape.
            if self._stop.wait(max(remaining, 0.0)):
                self._cues = chain([cue], self._cues)
                return False
            self.lateness = max(self.lateness, time.monotonic() - origin - due)
            self._stage.play(cue)
        return True
