"""Commands that read and change a running twin."""

from __future__ import annotations

import contextlib
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from typing import TYPE_CHECKING, Annotated, Any

import typer

from planetary_twin_py.terminal.arguments import complete_parameter
from planetary_twin_py.terminal.console import make_console
from planetary_twin_py.terminal.messages import fail, note, remark
from planetary_twin_py.terminal.settings import in_words, read_as_si
from planetary_twin_py.terminal.unit_options import SECONDS

if TYPE_CHECKING:
    from .remote import Remote

NAMESPACE = "/planetary_twin"
SHORTEST_WATCH = 0.1  # [s]
Namespace = Annotated[str, typer.Option(help="Namespace of the twin.")]
# A value may start with "-", which would otherwise be taken for an option.
_NEGATIVE = {"ignore_unknown_options": True}

Name = Annotated[
    str, typer.Argument(help="Name of the parameter.", autocompletion=complete_parameter)
]

param = typer.Typer(no_args_is_help=True, help="Parameters of a running twin.")


@contextmanager
def _twin(namespace: str) -> Iterator[Remote]:
    """Connect to the running twin; a refusal ends the command with one line."""
    from .remote import Remote

    try:
        with Remote(namespace) as remote:
            yield remote
    except ValueError as refusal:
        fail(refusal)
    except OSError as silence:
        fail(silence, 1)


@param.command("list")
def list_(namespace: Namespace = NAMESPACE) -> None:
    """
    List all parameters with values, ranges and meanings.

    Example: planetary-twin param list
    """
    from rich.table import Table

    with _twin(namespace) as twin:
        table = Table(box=None, header_style="bold", pad_edge=False)
        for title in ("parameter", "value", "range", "meaning"):
            table.add_column(title, justify="right" if title == "value" else "left")
        for setting in twin.settings():
            limits = "fixed" if setting.fixed else setting.limits
            table.add_row(setting.name, _shown(setting.value), limits, setting.description)
        make_console(markup=False).print(table)  # units are in brackets


@param.command("get")
def get(
    name: Name,
    namespace: Namespace = NAMESPACE,
) -> None:
    """
    Print the value of a parameter.

    Example: planetary-twin param get backlash
    """
    with _twin(namespace) as twin:
        print(_shown(twin.setting(name).value))


@param.command("set", context_settings=_NEGATIVE)
def set_(
    name: Name,
    value: Annotated[str, typer.Argument(help="In SI, or with a unit: '0.3 um', '2000 rpm'.")],
    namespace: Namespace = NAMESPACE,
) -> None:
    """
    Change a parameter.

    Example: planetary-twin param set backlash "0.3 um"
    """
    with _twin(namespace) as twin:
        without_effect = twin.set(name, value)
        if without_effect:
            remark(f"warning: {without_effect}")
        print(_in_words(name, twin.setting(name).value))


def op(
    changes: Annotated[
        list[str], typer.Argument(metavar="NAME=VALUE...", help="In SI, or with a unit.")
    ],
    ramp: Annotated[
        float, typer.Option(help="Simulated time until the values are reached.", **SECONDS)
    ] = 0.0,
    namespace: Namespace = NAMESPACE,
) -> None:
    """
    Change several quantities of a running twin at one simulated instant, or in a ramp.

    Example: planetary-twin op input_speed=2000rpm lambda_ratio=1.5 --ramp 2
    """
    typed = dict(_pair(change) for change in changes)
    with _twin(namespace) as twin:
        instant, without_effect = twin.operate(typed, ramp)
        _say_units(typed)
        if without_effect:
            remark(f"warning: {without_effect}")
        print(f"{', '.join(typed)} from {instant:g} s of simulated time on")


def _say_units(typed: Mapping[str, str]) -> None:
    """Print the unit that was assumed for each quantity without a unit."""
    from planetary_twin_py.scene.live import unit_of_live
    from planetary_twin_py.units.conversion import is_number

    for name, value in typed.items():
        if (unit := unit_of_live(name)) and is_number(value):
            note(read_as_si(name, float(value), unit))


def _in_words(name: str, value: Any) -> str:
    """Return name and value, with both units of a quantity that has one."""
    from planetary_twin_py.scene.live import unit_of_live

    unit = unit_of_live(name)
    return in_words(name, value, unit) if unit else f"{name} = {_shown(value)}"


def _pair(change: str) -> tuple[str, str]:
    name, equals, value = change.partition("=")
    if not (name and equals):
        fail(f"{change!r}: must be NAME=VALUE")
    return name, value


def _shown(value: Any) -> str:
    return f"{value:g}" if isinstance(value, float) else str(value)


def monitor(
    namespace: Namespace = NAMESPACE,
    duration: Annotated[
        float | None, typer.Option(help="Time to watch [s], from 0.1; without: until Ctrl-C.")
    ] = None,
) -> None:
    """
    Show the quantities of a running twin and their recent history.

    Example: planetary-twin monitor --duration 10
    """
    if duration is not None and not duration >= SHORTEST_WATCH:
        fail(f"--duration = {duration:g} s: must be at least {SHORTEST_WATCH:g} s")
    from .monitor import watch

    with contextlib.suppress(KeyboardInterrupt):
        try:
            watch(namespace, duration)
        except OSError as silence:
            fail(silence, 1)
