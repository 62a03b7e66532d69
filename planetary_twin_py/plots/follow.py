"""What `follow` has estimated over time: teeth, changed teeth, and friction level."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ..following.state import Following
from ..following.teeth.search import ALARM
from ..text.stamps import instant, is_date
from .style import BLUE, CYCLE, GREY, WIDTH, applied

HEIGHT = 2.1  # of a row [in]

Tooth = tuple[str, int]
"""Gear and number."""


def follow_diagram(
    name: str, teeth: Mapping[str, int], states: Sequence[Following], first: float = 0.0
) -> Figure:
    """Draw estimates over time, with a dotted line where a change has been found.

    Args:
        name: name of the scene, for the title.
        teeth: number of teeth by gear, in the order of `Following.every_z`.
        states: estimated states, in the order of time.
        first: stamp of the first reading [s], from which times count if it is a date.

    Returns:
        The figure: friction level with its 95 % interval; with encoders also the significance of
        every tooth, and the loss of stiffness of changed teeth.

    Raises:
        ValueError: there is no state with a time.
    """
    states = [state for state in states if np.isfinite(state.time)]
    if not states:
        raise ValueError("there is no estimate to draw")
    start = first if is_date(first) else 0.0
    states = [_since(start, state) for state in states]
    every = [(gear, number) for gear, count in teeth.items() for number in range(count)]
    changed = list(dict.fromkeys((t.gear, t.tooth) for state in states for t in state.teeth))
    rows = 1 + any(state.every_z for state in states) + bool(changed)
    with applied():
        figure = Figure(figsize=(WIDTH, rows * HEIGHT), layout="constrained")
        axes = list(figure.subplots(rows, 1, squeeze=False, sharex=True)[:, 0])
        _friction(axes[-1], states)
        if any(state.every_z for state in states):
            _significance(axes[0], states, {tooth: every.index(tooth) for tooth in changed})
        if changed:
            _losses(axes[-2], states, changed)
        for panel in axes:
            for event in states[-1].events:
                panel.axvline(event.found, color=GREY, linewidth=0.8, linestyle=":")
        axes[0].set_title(f"{name}: {_headline(states[-1])}")
        axes[-1].set_xlabel(f"Time since {instant(first)} UTC [s]" if start else "Time [s]")
    return figure


def _since(start: float, state: Following) -> Following:
    """The state with times that count from `start` [s], as far as they are drawn."""
    events = tuple(replace(event, found=event.found - start) for event in state.events)
    return replace(state, time=state.time - start, events=events)


def _headline(state: Following) -> str:
    if not state.events:
        return state.unchanged
    first, *others = state.events
    more = f", and {len(others)} more" if others else ""
    return f"{first.what}, found at {first.found:.1f} s{more}"


def _significance(axes: Axes, states: Sequence[Following], changed: Mapping[Tooth, int]) -> None:
    """Significance of every tooth in each hunting period; teeth that have changed in colour."""
    judged = [state for state in states if state.every_z]
    time, every_z = (np.array([getattr(state, n) for state in judged]) for n in ("time", "every_z"))
    axes.plot(time, every_z, color=GREY, linewidth=0.4, alpha=0.5)
    for n, ((gear, number), column) in enumerate(changed.items()):
        label = f"{gear} tooth {number}"
        axes.plot(time, every_z[:, column], color=CYCLE[n % len(CYCLE)], label=label)
    axes.axhline(ALARM, color="black", linewidth=0.8, linestyle="--", label="limit of an event")
    axes.set_ylabel("Each tooth, z [-]")
    axes.legend(loc="upper left")


def _losses(axes: Axes, states: Sequence[Following], changed: Sequence[Tooth]) -> None:
    """Loss of stiffness of changed teeth, with 95 % intervals."""
    for n, (gear, number) in enumerate(changed):
        rows = [
            (state.time, tooth.loss.value, tooth.loss.low, tooth.loss.high)
            for state in states
            for tooth in state.teeth
            if (tooth.gear, tooth.tooth) == (gear, number)
        ]
        time, value, low, high = np.array(rows).T
        colour = CYCLE[n % len(CYCLE)]
        axes.plot(time, 100.0 * value, ".-", color=colour, label=f"{gear} tooth {number}")
        axes.fill_between(time, 100.0 * low, 100.0 * high, color=colour, alpha=0.2, linewidth=0.0)
    axes.set_ylim(bottom=0.0)
    axes.set_ylabel("Loss of stiffness,\nif a crack [%]")
    axes.legend(loc="upper left")


def _friction(axes: Axes, states: Sequence[Following]) -> None:
    """Friction level with its 95 % interval, where it is identifiable."""
    estimates = [(state.time, state["friction_level"]) for state in states]
    time = np.array([at for at, _ in estimates])
    value, low, high = np.array(
        [(estimate.value, estimate.low, estimate.high) for _, estimate in estimates]
    ).T
    axes.plot(time, value, color=BLUE)
    axes.fill_between(time, low, high, color=BLUE, alpha=0.2, linewidth=0.0)
    axes.set_ylabel("Friction level [-]")
    if np.isnan(value).all():
        axes.text(0.5, 0.5, "not identifiable", transform=axes.transAxes, ha="center")
