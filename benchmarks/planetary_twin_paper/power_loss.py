"""Figure 11: power loss ratio against lambda ratio and speed."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from planetary_twin_py.plots.style import CYCLE, panels

from .entry import Claim, Entry
from .evidence import Evidence
from .judge import falls, percent
from .study import Study


def power_loss(evidence: Evidence) -> Entry:
    """Figure 11."""
    ours, printed = (_ratio(study) for study in (evidence.study, evidence.printed_study))
    efficiency, ledger = 1.0 - ours, evidence.printed_study.over_grid(lambda o: o.ledger_efficiency)
    own = evidence.study.over_grid(lambda o: o.ledger_efficiency)
    gain = float(((ledger - 1.0) / printed).mean())
    residual = max(
        abs(outcome.residual)
        for study in (evidence.study, evidence.printed_study)
        for outcome in study.outcomes
    )
    return Entry(
        number="Figure 11",
        title="power loss ratio against lambda and speed",
        claims=(
            _claim("lambda", ours, printed, 1),
            _claim("speed", ours, printed, 2),
        ),
        remarks="The paper does not define the ratio; here it is the sliding power f Vs (16) of "
        f"all teeth over the input power. The efficiency is {efficiency.min():.2%} to "
        f"{efficiency.max():.2%}, and by the energy ledger {own.min():.2%} to {own.max():.2%}. "
        "With the printed friction torque P/w and its signs, the efficiency by the ledger is "
        f"{ledger.min():.2%} to {ledger.max():.2%}: friction supplies {gain:.2f} times the power "
        f"that sliding should dissipate. The residual of the ledger is at most {residual:.1e} of "
        "the input work.",
        picture=_draw(evidence.study, ours, printed),
        figures={
            "loss_ratio": ours,
            "loss_ratio_printed": printed,
            "ledger_efficiency_printed": ledger,
        },
    )


def _ratio(study: Study) -> np.ndarray:
    return study.over_grid(lambda o: o.sliding_loss / o.input_power)


def _claim(name: str, ours: np.ndarray, printed: np.ndarray, axis: int) -> Claim:
    return Claim(
        says=f"the loss decreases with {name}",
        ours=_change(ours, axis),
        printed=_change(printed, axis),
        holds=falls(ours, axis),
        printed_holds=falls(printed, axis),
        why=f"the loss does not decrease with {name}",
    )


def _change(ratio: np.ndarray, axis: int) -> str:
    ends = np.moveaxis(ratio, axis, -1)[0, 0]
    return f"{ends[0]:.3%} to {ends[-1]:.3%} of the input ({percent(ratio, axis):+.1f} % at most)"


def _draw(study: Study, ours: np.ndarray, printed: np.ndarray) -> Figure:
    figure, axes = panels(2, 2.8)
    ratios, speeds = study.grid.lambda_ratios, study.grid.speeds
    for place, loss, title in zip(
        axes, (ours, printed), ("scene paper", "scene paper_printed, f Vs alone"), strict=True
    ):
        for n, (speed, colour) in enumerate(zip(speeds, CYCLE, strict=False)):
            place.plot(ratios, 100 * loss[0, :, n], "o-", color=colour, label=f"{speed:g} rpm")
        place.set_title(title)
        place.set_xlabel("lambda ratio")
    axes[0].set_ylabel("power loss [% of the input]")
    axes[1].legend()
    return figure
