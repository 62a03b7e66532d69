"""Commands that ask and change a running twin."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, Annotated, Any

import typer

if TYPE_CHECKING:
    from .remote import Remote

NAMESPACE = "/planetary_twin"
Namespace = Annotated[str, typer.Option(help="Of the twin, where several run.")]

param = typer.Typer(no_args_is_help=True, help="Parameters of a running twin.")


@contextmanager
def _twin(namespace: str, command: str) -> Iterator[Remote]:
    """The twin that runs; what it refuses ends the command in one line."""
    from .remote import Remote

    try:
        with Remote(namespace) as remote:
            yield remote
    except ValueError as refusal:
        print(f"planetary-twin {command}: {refusal}", file=sys.stderr)
        raise typer.Exit(1) from None


@param.command("list")
def list_(namespace: Namespace = NAMESPACE) -> None:
    """All parameters with values, ranges and meanings."""
    from rich.console import Console
    from rich.table import Table

    with _twin(namespace, "param list") as twin:
        table = Table(box=None, header_style="bold", pad_edge=False)
        for title in ("parameter", "value", "range", "meaning"):
            table.add_column(title, justify="right" if title == "value" else "left")
        for setting in twin.settings():
            limits = "fixed" if setting.fixed else setting.limits
            table.add_row(setting.name, _shown(setting.value), limits, setting.description)
        Console(markup=False).print(table)  # units stand in brackets


@param.command("get")
def get(
    name: Annotated[str, typer.Argument(help="Of the parameter.")], namespace: Namespace = NAMESPACE
) -> None:
    """The value of a parameter."""
    with _twin(namespace, "param get") as twin:
        print(_shown(twin.setting(name).value))


@param.command("set")
def set_(
    name: Annotated[str, typer.Argument(help="Of the parameter.")],
    value: Annotated[str, typer.Argument(help="In SI, or with a unit: '0.3 um', '2000 rpm'.")],
    namespace: Namespace = NAMESPACE,
) -> None:
    """Change a parameter."""
    with _twin(namespace, "param set") as twin:
        twin.set(name, value)
        print(f"{name} = {_shown(twin.setting(name).value)}")


def op(
    changes: Annotated[
        list[str], typer.Argument(metavar="NAME=VALUE...", help="In SI, or with a unit.")
    ],
    ramp: Annotated[
        float, typer.Option(help="Simulated seconds until they are reached.", min=0.0)
    ] = 0.0,
    namespace: Namespace = NAMESPACE,
) -> None:
    """Change several quantities of a running twin at one simulated instant, or from it on."""
    typed = dict(_pair(change) for change in changes)
    with _twin(namespace, "op") as twin:
        instant = twin.operate(typed, ramp)
        print(f"{', '.join(typed)} from {instant:g} s")


def _pair(change: str) -> tuple[str, str]:
    name, equals, value = change.partition("=")
    if not (name and equals):
        print(f"planetary-twin op: {change!r}: must be NAME=VALUE", file=sys.stderr)
        raise typer.Exit(1)
    return name, value


def _shown(value: Any) -> str:
    return f"{value:g}" if isinstance(value, float) else str(value)


def monitor(
    namespace: Namespace = NAMESPACE,
    duration: Annotated[
        float | None, typer.Option(help="Seconds to watch; without: until Ctrl-C.", min=0.1)
    ] = None,
) -> None:
    """Show a running twin live: figures, and how they have changed."""
    from .monitor import watch

    _end_quietly(lambda: watch(namespace, duration))


def _end_quietly(task: Callable[[], None]) -> None:
    try:
        task()
    except KeyboardInterrupt:
        pass
    except ValueError as refusal:
        print(f"planetary-twin monitor: {refusal}", file=sys.stderr)
        raise typer.Exit(1) from None
