"""Writes the page that the first argument names."""

from __future__ import annotations

import sys
from pathlib import Path

from .compact import rig_lost_motion, rig_orders, rig_stiffness
from .compact_losses import rig_estimates, rig_losses, rig_predictions
from .published import helicopter, others, trends, two_actuators
from .row import Row

HEAD = """# Measured and published figures

`make measured` writes this page. Each table compares measured or published figures with those of
the twin.

- **agrees**: within the stated bound, or the trend has the same sign.
- **misses**: outside the bound, or not modelled. The reason is below the table.
- **input**: this figure is a parameter of the twin, so the row is no evidence.
- **prediction**: there is no reading to compare with.
- **undecided**: the line of the twin has another cause, or that of the rig is not above the noise.

All measured figures come from the named sources; this project has no measurements of its own.
"""

SECTIONS = {
    "COMPAct test rig": (
        "7.2:1, 25/65/155 printed teeth, module 0.5 mm, ring held. "
        "[COMPAct](https://github.com/singhaman1750/COMPAct), ICRA 2026, arXiv 2510.07197, MIT "
        "licence. Scene `compact_actuator`; data and licence are in `tests/data/compact`.",
        (rig_lost_motion, rig_stiffness, rig_orders, rig_estimates, rig_losses, rig_predictions),
    ),
    "Two 6:1 actuators": (
        "Loss of both, back to back: 0.094 T + 0.125 N m + 0.0040 N m s w (737 windows, rms 0.13 "
        "N m). Their lost motion with couplings is 18.8 mrad, which is a parameter of the twin. "
        "[actuator-dynamometer](https://github.com/karthikurs/actuator-dynamometer); "
        "figures only, because its data have no licence.",
        (two_actuators,),
    ),
    "Helicopter stages": (
        "Planetary stage: NASA 1990, ADA231724. OH-58A, 11 oils at 6060 rpm: Coy, NASA. The twin "
        "is `helicopter_stage` of the [gallery](gallery.md#helicopter-stage).",
        (helicopter,),
    ),
    "Trends of losses": (
        "Talbot, Kahraman and Singh 2012: planetary gear sets on a test rig. The twin is "
        "`helicopter_stage` with 300 N m.",
        (trends,),
    ),
    "Load sharing, modes, frequencies": (
        "Guo and Keller, NREL 2020; Ericson and Parker 2013; a rig with 21/31/84 teeth; the SNU "
        "data set.",
        (others,),
    ),
}


def section(title: str, source: str, rows: list[Row]) -> str:
    """A heading, the source, a table, and one remark for each row."""
    lines = [
        f"\n## {title}\n",
        f"{source}\n",
        "| figure | measured | twin | verdict |",
        "|---|---|---|---|",
    ]
    lines += [f"| {row.what} | {row.measured} | {row.twin} | {row.verdict} |" for row in rows]
    remarks = dict.fromkeys(row.remark for row in rows)
    for remark in remarks:
        of = [row.what for row in rows if row.remark == remark]
        lines.append(
            ("\n" if remark is rows[0].remark else "") + f"- *{'; '.join(of)}*: {remark.strip()}"
        )
    return "\n".join(lines) + "\n"


def main() -> None:
    """Compute all rows and write the page."""
    text = HEAD
    for title, (source, parts) in SECTIONS.items():
        rows = [row for part in parts for row in part()]
        text += section(title, source, rows)
        print(title, [row.verdict for row in rows], flush=True)
    Path(sys.argv[1]).write_text(text)


main()
