"""Results of `planetary-twin wear`: tables and lines."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..terminal.messages import remark
from ..terminal.names import shown

if TYPE_CHECKING:
    from rich.table import Table

    from ..studies.wear.result import Wear
    from ..terminal.tables import TableConsole

HOUR = 3600.0  # [s]

_CLAIM = (
    "Depths hold for this coefficient only, and coefficients of tests differ by powers of ten: fit "
    "it with --measured-backlash-change. Shape, place and ratios of the wear do not depend on it."
)
_FITTED = (
    "The coefficient is fitted to the measured change of the backlash: depths hold for the "
    "oil, the surfaces and the load of this measurement."
)


def print_wear(console: TableConsole, name: str, found: Wear) -> None:
    """Print the wear of flanks and meshes, and what the depths are worth.

    Args:
        console: console to print on.
        name: name of the scene.
        found: the results.
    """
    console.print(_flank_table(f"{shown(name)} after {found.duration / HOUR:g} h", found))
    console.print(_mesh_table(found))
    for line in _summary(found):
        console.print(line, markup=False)
    remark(_FITTED if found.fitted else _CLAIM)


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
