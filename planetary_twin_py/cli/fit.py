"""`planetary-twin fit`: parameters from a recording."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Annotated, Any

import typer

from ._arguments import FileArgument, JsonOption, NamespaceOption
from ._fail import fail, need, remark
from ._figures import console_beside, put_figures
from ._settings import settings

if TYPE_CHECKING:
    from rich.console import Console

    from ..studies.fit.identify import Identified


def fit(
    file: FileArgument,
    free: Annotated[
        str,
        typer.Option(
            metavar="NAMES",
            help="Fields to estimate, by commas; NAME=VALUE begins the search elsewhere than "
            "at the recorded value.",
        ),
    ],
    from_: Annotated[
        float | None, typer.Option("--from", metavar="S", help="Simulated second to begin at.")
    ] = None,
    to: Annotated[float | None, typer.Option(metavar="S", help="Second to end at.")] = None,
    observe: Annotated[
        str, typer.Option(metavar="NAMES", help="What was measured, by commas.")
    ] = "dte_rms,power_loss",
    noise: Annotated[
        list[str] | None,
        typer.Option(metavar="NAME=VALUE", help="Standard deviation of a reading, in SI."),
    ] = None,
    namespace: NamespaceOption = None,
    json_: JsonOption = None,
) -> None:
    """Estimate fields of the scene of FILE from what was measured, and say what it cannot tell.

    Without --from and --to: the longest second on which the operating point stays the same. A
    field that the readings do not tell is named in a warning; the exit code stays 0.

    Example: planetary-twin fit recordings/NAME --free lambda_ratio,input_torque
    """
    need("recording", "mcap", "rosbags")

    from ..studies.fit.identify import Search, identify
    from ..studies.fit.remarks import remarks

    console = console_beside(json_)
    try:
        search = Search(
            free=tuple(name for name, _ in map(_pair, _parts(free))),
            observe=tuple(map(_name, _parts(observe))),
            start={name: value for name, value in map(_pair, _parts(free)) if value},
            noise=_numbers(noise or []),
        )
        with console.status("simulating") as status:
            found = identify(
                file, search, namespace, from_, to,
                hear=lambda count: status.update(f"{count} simulations"),
            )  # fmt: skip
    except (ValueError, ArithmeticError) as error:
        fail(error)
    except OSError as error:
        fail(f"{error.filename}: {error.strerror}")
    told = list(remarks(found))
    _tell(console, found)
    for line in told:
        remark(f"warning: {line}")
    put_figures(_figures(found) | {"remarks": told}, json_)


def _name(text: str) -> str:
    return text.strip().replace("-", "_")


def _parts(text: str) -> list[str]:
    return [part for part in text.split(",") if part.strip()]


def _pair(text: str) -> tuple[str, str]:
    name, _, value = text.partition("=")
    return _name(name), value.strip()


def _numbers(given: list[str]) -> dict[str, float]:
    found = {}
    for name, value in settings(given).items():
        try:
            found[_name(name)] = float(value)
        except ValueError:
            raise ValueError(f"--noise {name} = {value!r}: must be a number in SI") from None
    return found


def _tell(console: Console, found: Identified) -> None:
    from rich.table import Table

    stretch, estimate = found.stretch, found.estimate
    table = Table(title=f"{stretch.scene.name}, {stretch.start:g} to {stretch.end:g} s")
    for heading in (
        "field",
        "estimate",
        f"{100.0 * found.confidence:g} % interval",
        "unit",
        "from",
    ):
        table.add_column(heading, justify="right")
    for k, parameter in enumerate(found.parameters):
        low, high, profiled = estimate.intervals[k]
        told = estimate.told(k)
        source = ("profile" if profiled else "curvature") if told else "tried"
        value = f"{estimate.values[k]:.6g}" if told else "not told"
        span = f"{low:.6g} to {high:.6g}"
        if math.isnan(low):
            span, source = "-", "only together"
        table.add_row(parameter.name, value, span, parameter.unit, source)
    console.print(table)
    console.print(f"{found.simulations} simulations in {found.wall_time:.1f} s", highlight=False)


def _figures(found: Identified) -> dict[str, Any]:
    estimate = found.estimate
    parameters = {
        p.name: {
            "estimate": float(estimate.values[k]) if estimate.told(k) else None,
            "low": _finite(estimate.intervals[k].low),
            "high": _finite(estimate.intervals[k].high),
            "unit": p.unit,
            "told": estimate.told(k),
            "at_bound": estimate.at_bound[k],
            "profiled": estimate.intervals[k].profiled,
        }
        for k, p in enumerate(found.parameters)
    }
    return {
        "parameters": parameters,
        "confidence": found.confidence,
        "correlation": [[_finite(value) for value in row] for row in estimate.correlation],
        "untold": [[found.parameters[k].name for k in group] for group in estimate.untold],
        "excess": estimate.excess,
        "noise": {
            readings.name: _finite(float(noise.reading.max()))
            for readings, noise in zip(found.yardstick.recorded, found.yardstick.noise, strict=True)
        },
        "contact_fraction": found.contact_fraction,
        "from_s": found.stretch.start,
        "to_s": found.stretch.end,
        "simulations": found.simulations,
        "wall_time_s": found.wall_time,
    }


def _finite(value: float) -> float | None:
    """JSON has no infinity and no NaN."""
    return float(value) if math.isfinite(value) else None
