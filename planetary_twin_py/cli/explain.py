"""`planetary-twin explain`: what a scene models, what it does not, and what each term does."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Any

import typer

from ._arguments import JsonOption, SceneArgument
from ._fail import fail
from ._figures import console_beside, put_figures
from ._interrupt import interruptible

if TYPE_CHECKING:
    from rich.table import Table

    from ..explanation.measure import Explanation, Figures
    from ..scene import Scene


def explain(
    scene: SceneArgument = "paper",
    duration: Annotated[float, typer.Option(help="Simulated seconds of every run.")] = 0.1,
    json_: JsonOption = None,
) -> None:
    """Tell what SCENE models, and measure what leaving out each term would change.

    Example: planetary-twin explain cracked_tooth --duration 0.2
    """

    from ..explanation.measure import explain as measure
    from ..scene import load_scene

    console = console_beside(json_)
    try:
        loaded = load_scene(scene)
        with console.status("running the scene") as status:
            found = interruptible(
                lambda: measure(
                    loaded, duration, lambda name: status.update(f"running it without {name}")
                )
            )
    except ValueError as error:
        fail(error)
    console.print(f"[bold]{loaded.name}[/bold]: {loaded.description}\n")
    console.print(_table(loaded, found))
    console.print(_limits(loaded))
    put_figures(_as_figures(found), json_)


def _table(scene: Scene, found: Explanation) -> Table:
    from rich.table import Table

    figures = found.figures
    table = Table(
        title="Modelled, and what the scene would be without it",
        caption=f"as it is: mean DTE {1e6 * figures.dte:.4g} um, its vibration "
        f"{1e6 * figures.dte_vibration:.4g} um rms, power loss {figures.power_loss:.4g} W",
    )
    for heading in ("term", "law"):
        table.add_column(heading)
    for heading in ("mean DTE", "vibration", "power loss", "run time"):
        table.add_column(heading, justify="right")
    for effect in found.effects:
        table.add_row(
            effect.term.name,
            effect.term.law,
            *(_change(figures, effect.without, name) for name in _JUDGED),
            f"{-100 * effect.cost:+.0f} %",
        )
    return table


_JUDGED = ("dte", "dte_vibration", "power_loss")


def _change(with_: Figures, without: Figures, name: str) -> str:
    before, after = getattr(with_, name), getattr(without, name)
    return f"{100 * (after / before - 1.0):+.2f} %" if before > 0.0 else "-"


def _limits(scene: Scene) -> Table:
    from rich.table import Table

    from ..explanation.terms import limits

    table = Table("not modelled", "so", title="Left out")
    for limit in limits(scene):
        table.add_row(*limit)
    return table


def _as_figures(found: Explanation) -> dict[str, Any]:
    return {
        "scene": found.figures._asdict(),
        "terms": [
            {
                "name": effect.term.name,
                "law": effect.term.law,
                "without": effect.without._asdict(),
                "cost": effect.cost,
            }
            for effect in found.effects
        ],
    }
