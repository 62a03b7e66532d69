"""Reports of the follower in /diagnostics: inputs, clock, estimator and condition."""

from __future__ import annotations

import math
from collections.abc import Sequence, Set
from typing import NamedTuple

from diagnostic_msgs.msg import DiagnosticStatus

from planetary_twin_py.following.estimate import Event
from planetary_twin_py.following.state import Following

from ..base.diagnostics import Row

CONDITION = "condition"
REPORTS = "inputs", "clock", "estimator", CONDITION
_UNUSED = (
    "late", "doubled", "outlying", "ahead", "implausible", "encoder_late", "encoder_lost",
)  # fmt: skip


class Limits(NamedTuple):
    """Limits above which a condition is an error."""

    friction: float
    tooth: float


class Feed(NamedTuple):
    """State of the incoming readings."""

    silent: float
    """Time since the last new estimate [s]."""
    timeout: float
    """Limit of this time [s]."""
    refusal: str
    """Reason why the readings contradict the scene; empty if they do not."""
    jumps: int
    """Number of times that stamps have jumped back."""
    behind: float
    """Time that the last messages waited to be processed [s]."""
    shared: Sequence[str]
    """Topics of one sensor that have several publishers."""
    acknowledged: Set[tuple[str, float]] = frozenset()
    """Acknowledged events, by `key_of`."""


def key_of(event: Event) -> tuple[str, float]:
    """Return what identifies an event while its figures change."""
    return event.what, event.since


def rows(state: Following, feed: Feed, limits: Limits) -> list[Row]:
    """Return the four reports."""
    parts = (
        _inputs(state, feed),
        _clock(state, feed),
        _estimator(state),
        _condition(state, limits, feed),
    )
    return [Row(f"follower: {report}", *part) for report, part in zip(REPORTS, parts, strict=True)]


_Part = tuple[bytes, str, dict[str, str]]


def _inputs(state: Following, feed: Feed) -> _Part:
    values = {name: str(count) for name, count in state.counters.items()}
    if feed.refusal:
        return DiagnosticStatus.ERROR, feed.refusal, values
    if feed.shared:
        words = ", ".join(feed.shared)
        return DiagnosticStatus.WARN, f"several publishers, must be one sensor: {words}", values
    if math.isnan(state.time):
        return DiagnosticStatus.STALE, "no readings yet", values
    if feed.silent > feed.timeout:
        return DiagnosticStatus.STALE, f"no readings for {feed.silent:.1f} s", values
    unused = {name: state.counters[name] for name in _UNUSED if state.counters.get(name)}
    if unused:
        words = ", ".join(f"{name} {count}" for name, count in unused.items())
        return DiagnosticStatus.OK, f"received; not used: {words}", values
    return DiagnosticStatus.OK, "received", values


def _clock(state: Following, feed: Feed) -> _Part:
    lines = [line for line in state.remarks if line.startswith("clock")]
    if feed.jumps:
        lines.append(f"stamps have jumped back {feed.jumps} times")
    level = DiagnosticStatus.WARN if lines else DiagnosticStatus.OK
    values = {"jumps": str(feed.jumps), "behind": f"{feed.behind:.3f}"}
    return level, "; ".join(lines) or "stamps agree with the times of arrival", values


def _estimator(state: Following) -> _Part:
    values: dict[str, str] = {one.name: one.status for one in state.estimates}
    lines = [line for line in state.remarks if not line.startswith("clock")]
    level = DiagnosticStatus.WARN if lines else DiagnosticStatus.OK
    estimated = sum(one.status == "ESTIMATED" for one in state.estimates)
    return (
        level,
        "; ".join(lines) or f"{estimated} of {len(values)} quantities are estimated",
        values,
    )


def _condition(state: Following, limits: Limits, feed: Feed) -> _Part:
    """
    Return WARN for a detected change, ERROR if its whole interval is above the limit.

    An acknowledged event is no longer a warning; what is above a limit remains an error.
    """
    every = {event: f"{event.what}: {event.evidence}" for event in state.events}
    values = {f"event {n}": line for n, line in enumerate(every.values(), 1)}
    lines = [line for event, line in every.items() if key_of(event) not in feed.acknowledged]
    friction = next(one for one in state.estimates if one.name == "friction_level")
    worst = [
        f"friction level above {limits.friction:g}: {friction.low:.3g} to {friction.high:.3g}"
    ] * (friction.low > limits.friction)
    worst += [
        f"{tooth.gear} tooth {tooth.tooth}: more than {100 * limits.tooth:g} % of stiffness lost"
        for tooth in state.teeth
        if tooth.loss.low > limits.tooth
    ]
    if worst:
        return DiagnosticStatus.ERROR, "; ".join(worst), values
    if lines:
        return DiagnosticStatus.WARN, "; ".join(lines), values
    found = f"{len(every)} events, all acknowledged" if every else state.unchanged
    return DiagnosticStatus.OK, found, values
