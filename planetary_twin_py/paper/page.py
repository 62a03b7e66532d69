"""The page that puts the paper and the twin side by side, and its figures for machines."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from string import Template
from typing import Any

import numpy as np

from ..plots.style import applied, save
from .entry import Claim, Entry
from .equations import EQUATIONS, Equation
from .evidence import Evidence
from .study import DURATION, SAMPLE_RATE, SETTLED, TOLERANCE, Study

_PAGE = Template("""# The paper, side by side

Made by `planetary-twin paper`. It recomputes every table and figure of K. Salagianni,
P. Nikolakopoulos, S. Theodossiades: *Dynamic and tribological study of a planetary gearbox with
local nonlinearities*, Proc. IMechE Part K 231 (2017) 504-518.

- **ours** is the scene `paper`: the paper's data, with a well-founded form wherever a printed one
  has the wrong sign or dimension. **As printed** is the scene `paper_printed`, with every printed
  form that can run. [The model](model.md) says why each differs.
- The text of the paper is at hand, its figures are not: of them only what captions and prose say
  can be compared, so no value is read off a curve.
- A statement is a number or a fact, or a trend, which must hold at every step and change by a
  thousandth at least. It is reached if either form gives it; where only the printed form does, the
  reason says why ours differs.
- Verdicts follow from the statements reached. *Reproduced*: all of them, and one at least is a
  number or a fact. *Trend reproduced*: all trends, of which there is one at least, but no number or
  fact is stated, or one is not reached; the reason says which. *Cannot be*: a trend is not reached,
  or no trend is stated and a number or a fact is not reached.
- The study runs the dynamic model at $points points: backlash $backlashes um, lambda
  $lambdas, $speeds rpm, at 63 N m, and for Figure 7
  at $torques N m. Each is run for both scenes over $duration s, of which the
  part after $settled s counts, at tolerance $tolerance,
  sampled at $rate kHz: a largest force is that of every other sample to a thousandth.

## Verdicts

$summary

## Entries

$entries

## Equations

Files are below `planetary_twin_py/`. A choice is a field of the scene and the value that turns the
printed form on: `planetary-twin simulate paper --set FIELD=VALUE`, or in a scene of one's own.

$equations

## What `paper_printed` leaves as it is

$left_out
""")


def write_page(
    entries: Sequence[Entry], evidence: Evidence, out: Path, suffix: str = ".png"
) -> None:
    """Write the page to `out`, its pictures into a folder of the same name beside it.

    Raises:
        OSError: they cannot be written.
        ValueError: no picture ends in `suffix`.
    """
    folder = out.with_suffix("")
    folder.mkdir(parents=True, exist_ok=True)
    with applied():
        for entry in entries:
            if entry.picture is not None:
                save(entry.picture, str(folder / f"{entry.slug}{suffix}"))
    grid = evidence.study.grid
    out.write_text(
        _PAGE.substitute(
            points=len(evidence.study.points) - len(grid.torques),
            backlashes=_values(1e6 * np.array(grid.backlashes)),
            lambdas=_values(grid.lambda_ratios),
            speeds=_values(grid.speeds),
            torques=_values(grid.torques),
            duration=DURATION,
            settled=SETTLED,
            tolerance=TOLERANCE,
            rate=f"{1e-3 * SAMPLE_RATE:g}",
            summary=_table(("", "what", "verdict"), [_summary(entry) for entry in entries]),
            entries="\n\n".join(_entry(entry, folder.name, suffix) for entry in entries),
            equations=_table(
                ("equation", "law", "file", "default", "printed form", "choice"),
                [_equation(equation) for equation in EQUATIONS],
            ),
            left_out=evidence.printed.description,
        ),
        "utf-8",
    )


def _values(values: Any) -> str:
    return ", ".join(f"{value:g}" for value in values)


def _table(titles: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    lines = (titles, ["---"] * len(titles), *rows)
    return "\n".join("| " + " | ".join(cells) + " |" for cells in lines)


def _verdict(entry: Entry) -> str:
    if not entry.reason:
        return f"**{entry.verdict}**"
    return f"**{entry.verdict}**{' ' if entry.verdict.endswith('because') else '; '}{entry.reason}"


def _summary(entry: Entry) -> tuple[str, str, str]:
    anchor = f"{entry.number} {entry.title}".lower()
    anchor = "".join(c for c in anchor if c.isalnum() or c in " -").replace(" ", "-")
    return f"[{entry.number}](#{anchor})", entry.title, _verdict(entry)


def _entry(entry: Entry, folder: str, suffix: str) -> str:
    parts = [
        f"### {entry.number}: {entry.title}",
        _table(
            ("the paper states", "ours", "as printed"), [_claim(claim) for claim in entry.claims]
        ),
        f"Verdict: {_verdict(entry)}.",
        entry.remarks,
    ]
    if entry.picture is not None:
        parts.append(f"![{entry.number}: {entry.title}]({folder}/{entry.slug}{suffix})")
    return "\n\n".join(part for part in parts if part)


def _claim(claim: Claim) -> tuple[str, str, str]:
    ours = f"{_tick(claim.holds)} {claim.ours}" if claim.ours != "-" else "-"
    printed = f"{_tick(claim.printed_holds)} {claim.printed}" if claim.printed != "-" else "-"
    return claim.says, ours, printed


def _tick(holds: bool) -> str:
    return "yes:" if holds else "no:"


def _equation(equation: Equation) -> tuple[str, ...]:
    choice = f"`{equation.choice}`" if equation.choice else "-"
    return (
        equation.label,
        equation.law,
        f"`{equation.file}`",
        equation.default,
        equation.printed,
        choice,
    )


def figures(entries: Sequence[Entry], evidence: Evidence) -> dict[str, Any]:
    """What the page rests on, for machines; SI units, speeds of the study in rpm."""
    return {
        "entries": [
            {
                "number": entry.number,
                "title": entry.title,
                "verdict": str(entry.verdict),
                "reason": entry.reason,
                "claims": [_plain(vars(claim)) for claim in entry.claims],
                "figures": _plain(dict(entry.figures)),
            }
            for entry in entries
        ],
        "equations": [equation._asdict() for equation in EQUATIONS],
        "studies": {
            "paper": _rows(evidence.study),
            "paper_printed": _rows(evidence.printed_study),
        },
    }


def _rows(study: Study) -> list[dict[str, Any]]:
    return [
        point._asdict()
        | outcome._asdict()
        | {"sun": outcome.sun._asdict(), "ring": outcome.ring._asdict()}
        for point, outcome in zip(study.points, study.outcomes, strict=True)
    ]


def _plain(value: Any) -> Any:
    """With lists in place of arrays."""
    if isinstance(value, dict):
        return {name: _plain(item) for name, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [_plain(item) for item in value]
    if isinstance(value, (np.ndarray, np.generic)):
        return value.tolist()
    return value
