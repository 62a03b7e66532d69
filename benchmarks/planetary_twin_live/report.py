"""The results of the live benchmark as tables, as a page and as JSON values."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from rich.table import Table

from .measure import Figures, Punctuality

CORES = 0.25  # target: share of one core, 100 Hz, waveform at 50 kHz
RESIDENT = 350.0  # [MB] target
SLOPE = 1.0  # [MB/h] target


def as_json(figures: Figures) -> dict[str, Any]:
    """Return the values for `--json`; times in s, memory in MB and MB/h."""
    return {
        "machine": figures.machine,
        "duration": figures.duration,
        "punctuality": [_plain(p) for p in figures.punctuality],
        "costs": [_plain(cost) for cost in figures.costs],
        "memory": _plain(figures.memory),
    }


def _plain(value: Any) -> Any:
    """Return a record, and the records in it, as dictionaries."""
    if hasattr(value, "_asdict"):
        return {name: _plain(part) for name, part in value._asdict().items()}
    return value


Row = tuple[str, ...]
_TIMES: Row = ("publish rate", "what", "p50", "p99", "max")
_COSTS: Row = (
    "scene", "tolerance", "mesh cycles", "subscribers", "of a core", "real-time factor",
    "waveform",
)  # fmt: skip
_MEMORY: Row = ("seconds", "start", "end", "slope", "standard error")


def tables(figures: Figures) -> list[tuple[Row, list[Row]]]:
    """Return the titles and rows of each table."""
    times = [row for p in figures.punctuality for row in _times(p)]
    costs = [
        (
            c.scene, f"{c.tolerance:g}", c.mesh_cycles, str(c.listeners),
            _judged(f"{c.cores:.1%}", c.cores < CORES), f"{c.real_time_factor:.4f}", c.waveform,
        )
        for c in figures.costs
    ]  # fmt: skip
    m = figures.memory
    memory = (
        f"{m.duration:g}", f"{m.begin:.1f} MB", _judged(f"{m.end:.1f} MB", m.end < RESIDENT),
        _judged(f"{m.slope.value:.2f} MB/h", m.slope.value < SLOPE), f"{m.slope.error:.2f} MB/h",
    )  # fmt: skip
    return [(_TIMES, times), (_COSTS, costs), (_MEMORY, [memory])]


def _judged(figure: str, met: bool) -> str:
    """Return `figure`, and whether it misses its target."""
    return figure if met else f"{figure}, missed"


def _times(p: Punctuality) -> list[Row]:
    measured = {
        "jitter, sent": p.sent,
        "jitter, received": p.came,
        "set to answer": p.answer,
        "set to message": p.shown,
    }
    return [
        (f"{p.rate:g} Hz", what, *(f"{t * 1e3:.3f} ms" for t in quantiles))
        for what, quantiles in measured.items()
    ]


def remarks(figures: Figures) -> list[str]:
    """Return a line on messages and losses for each publish rate."""
    return [
        f"{p.rate:g} Hz: {p.messages} messages in {figures.duration:g} s, {p.lost} lost in "
        f"transit, real-time factor {p.real_time_factor:.4f}, {p.overruns} overruns"
        for p in figures.punctuality
    ]


def as_tables(figures: Figures) -> list[Table]:
    """Return the tables for a terminal."""
    made = []
    for titles, rows in tables(figures):
        table = Table(box=None, header_style="bold", pad_edge=False)
        for title in titles:
            side = "left" if title in titles[:2] else "right"
            table.add_column(title.replace(" ", "\n"), justify=side, no_wrap=True)
        for row in rows:
            table.add_row(*row)
        made.append(table)
    return made


def as_markdown(figures: Figures, command: str) -> str:
    """Return the text of `docs/real-time.md`; `command` is the command that produces it."""
    times, costs, memory = (_markdown(*table) for table in tables(figures))
    notes = "\n".join(f"- {remark}." for remark in remarks(figures))
    return f"""# Real time, measured

Made by `{command}`: a simulation in one process, measured from another
process, on {figures.machine}. Compare ratios if the machine is shared.

## Punctuality

The scene `paper`, waveform at 50 kHz, one subscriber.

- *Jitter*: deviation of the time between two `gearbox_state` from the period; *sent*: by the
  stamps of the publisher; *received*: by the clock of the subscriber.
- *Set to answer*, *set to message*: from the call of `set_parameters_atomically` to its response,
  and to the first `gearbox_state` with the new value. On average, half an interval of the latter
  is the wait for the next interval.

{times}

{notes}

## Processor

The simulation process at 100 Hz, waveform at 50 kHz, in real time; target: below {CORES:.0%} of a
core, *missed* where it is not. Each subscriber is a separate participant and receives
`gearbox_state` and `mesh_waveform`.
With `tolerance` 0, computing may take up to `compute_share`, see `msgs_spec/README.md`.

{costs}

## Memory

Resident memory; target: below {RESIDENT:g} MB, and growth below {SLOPE:g} MB/h; *missed* where it
is not.

{memory}
"""


def _markdown(titles: Row, rows: Sequence[Row]) -> str:
    lines = [titles, ("---",) * len(titles), *rows]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)
