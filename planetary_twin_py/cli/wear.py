"""`planetary-twin wear`: wear of all flanks after hours of operation."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ..terminal.arguments import JsonOption, SceneArgument, SetOption, picture_option
from ..terminal.console import progress_of
from ..terminal.json_output import console_beside, write_json
from ..terminal.messages import need, one_line_errors, remark, warn
from ..terminal.names import shown
from ..terminal.output_files import file_ending_in, writing
from ..terminal.settings import scene_with
from ..terminal.unit_options import read_quantity

if TYPE_CHECKING:
    from rich.table import Table

    from ..studies.wear.result import Wear

HOUR = 3600.0  # [s]


def wear(
    scene: SceneArgument,
    hours: Annotated[
        str,
        typer.Option(
            metavar="TIME", help="Time of operation: a number of hours, or with a unit, e.g. 1000h."
        ),
    ] = "1000h",
    measured_backlash_change: Annotated[
        str | None,
        typer.Option(
            metavar="LENGTH",
            help="Fit the coefficient to this growth of the backlash, e.g. 12um: of both kinds of "
            "mesh together, along the line of action.",
        ),
    ] = None,
    vibration: Annotated[
        bool,
        typer.Option(
            "--vibration",
            help="Take the loads from runs with the dynamics of SCENE, not from equilibrium.",
        ),
    ] = False,
    set_: SetOption = None,
    out: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE.yaml",
            help="Write SCENE with the worn flanks, for all other commands.",
            callback=file_ending_in(".yaml"),
        ),
    ] = None,
    picture: Annotated[Path | None, picture_option("Draw the profiles.")] = None,
    json_: JsonOption = None,
) -> None:
    """Compute the wear of all flanks of SCENE by its law durability.wear.

    The load is that of the operating point. Shape, place and ratios follow from the gears; depths
    are in proportion to a coefficient that has to be measured.

    Example: planetary-twin wear paper --set durability.wear.coefficient='1e-18 1/Pa' --hours 1000h
    """
    if picture is not None:
        need("plots", "matplotlib")
    from ..studies.wear.wear import wear as compute

    with one_line_errors(ArithmeticError):
        loaded = scene_with(scene, set_)
        measured = _length(measured_backlash_change)
        with progress_of("wear") as shown_part:
            found = compute(
                loaded,
                _time("--hours", hours),
                vibration,
                measured,
                report=lambda done: shown_part(done, 1.0),
            )
    console = console_beside(json_)
    console.print(_flank_table(f"{shown(loaded.name)} after {found.duration / HOUR:g} h", found))
    console.print(_mesh_table(found))
    for line in _summary(found):
        console.print(line, markup=False)
    remark(_CLAIM if not found.fitted else _FITTED)
    warn(found.remarks())
    if out is not None:
        import yaml

        content = found.scene.model_dump(mode="json", exclude_none=True)
        text = yaml.safe_dump(content, sort_keys=False, default_flow_style=None)
        with writing("--out", out):
            out.write_text(text, "utf-8")
    if picture is not None:
        from ..plots.style import save
        from ..plots.wear import wear_profiles

        with writing("--picture", picture):
            save(wear_profiles(found), str(picture))
    write_json(found.figures(), json_)


_CLAIM = (
    "Depths hold for this coefficient only, and coefficients of tests differ by powers of ten: fit "
    "it with --measured-backlash-change. Shape, place and ratios of the wear do not depend on it."
)
_FITTED = (
    "The coefficient is fitted to the measured change of the backlash: depths hold for the "
    "oil, the surfaces and the load of this measurement."
)


def _time(option: str, text: str) -> float:
    """A time [s] from a number of hours or a text with a unit."""
    try:
        return HOUR * float(text)
    except ValueError:
        return read_quantity(option, text, "s")


def _length(text: str | None) -> float | None:
    """A measured change of the backlash [m]."""
    return None if text is None else read_quantity("--measured-backlash-change", text, "m")


def _flank_table(title: str, found: Wear) -> Table:
    from rich.markup import escape
    from rich.table import Table

    table = Table(title=title)
    for heading in (
        "flank", "depth [µm]", "at [base pitches]", "at start [µm/h]", "at end [µm/h]", "mass [mg]",
    ):  # fmt: skip
        table.add_column(escape(heading), justify="left" if heading == "flank" else "right")
    for flank in found.flanks:
        n = flank.deepest
        table.add_row(
            _FLANKS[flank.name],
            f"{1e6 * flank.depth[n]:.4g}",
            f"{flank.position[n]:.3f}",
            f"{1e6 * HOUR * flank.first_rate[n]:.4g}",
            f"{1e6 * HOUR * flank.rate[n]:.4g}",
            f"{1e6 * flank.mass:.4g}",
        )
    return table


def _mesh_table(found: Wear) -> Table:
    from rich.markup import escape
    from rich.table import Table

    table = Table()
    headings = (
        "meshes", "deepest pair [µm]", "backlash [µm]", "DTE, mean [µm]",
        "DTE, peak to peak [µm]", "per µm of depth [µm]",
    )  # fmt: skip
    for heading in headings:
        table.add_column(escape(heading), justify="left" if heading == "meshes" else "right")
    for name, mesh in zip(("sun-planet", "planet-ring"), found.meshes, strict=True):
        before, after = mesh.error
        table.add_row(
            name,
            f"{1e6 * mesh.deepest:.4g}",
            f"{1e6 * mesh.backlash_change:+.4g}",
            f"{1e6 * mesh.mean_error:+.4g}",
            f"{1e6 * before:.4g} to {1e6 * after:.4g}",
            f"{mesh.error_per_depth:+.3f}" if mesh.deepest else "-",
        )
    return table


def _summary(found: Wear) -> list[str]:
    how = "fitted" if found.fitted else "given"
    shares = " ".join(f"{share:.4f}" for share in found.meshes[0].shares)
    return [
        f"{'wear coefficient, ' + how:<34}{found.coefficient:.4g} 1/Pa",
        f"{'backlash of both meshes':<34}{1e6 * found.backlash_change:+.4g} µm",
        f"{'load shares of the planets':<34}{shares}",
        f"{'updates of the profile':<34}{found.steps}",
    ]


_FLANKS = {
    "sun": "sun",
    "planet_sun": "planets, with the sun",
    "planet_ring": "planets, with the ring",
    "ring": "ring",
}
