"""Commands by name, each loaded on first use."""

from __future__ import annotations

import importlib
import pkgutil
from collections.abc import Callable, Iterator, Mapping
from functools import cache, partial
from importlib.metadata import EntryPoint, entry_points
from typing import Any

import typer
from typer.core import TyperGroup

from ..terminal.messages import fail
from ._help import PLAIN, Command

GROUP = "planetary_twin.commands"
_SENTENCE = 300  # characters at most
# Commands of the other packages, which a wheel of this package does not contain.
OF_NODES = ("monitor", "op", "param", "replay", "run")
OF_BENCHMARKS = ("bench", "bench-live", "bench-recorder", "paper")


class Group(TyperGroup):
    """A group that lists its commands by name and loads a command on first use."""

    def __init__(self, **attributes: Any) -> None:
        super().__init__(**attributes)
        self.commands: Mapping[str, Any] = Commands()  # type: ignore[assignment]

    def list_commands(self, ctx: Any) -> list[str]:
        """Return the names only; Typer's method would load every command."""
        return list(self.commands)

    def resolve_command(self, ctx: Any, args: list[str]) -> Any:
        """Find the command; of one that is not installed, say which package has it."""
        name = args[0]
        if name not in self.commands and name in (*OF_NODES, *OF_BENCHMARKS):
            part = "ROS nodes" if name in OF_NODES else "benchmarks"
            fail(
                f"{name}: needs the {part}, which are not installed; set up a clone of the "
                "repository (make setup), see docs/installing.md"
            )
        return super().resolve_command(ctx, args)

    def format_commands(self, ctx: Any, formatter: Any) -> None:
        """Write each command with the first sentence of its help."""
        rows = [
            (name, command.get_short_help_str(_SENTENCE)) for name, command in self.commands.items()
        ]
        with formatter.section("Commands"):
            formatter.write_dl(rows)


class Commands(Mapping[str, Any]):
    """Installed commands: those of this package, and those of entry points."""

    def __init__(self) -> None:
        self._loaders = _loaders()

    def __getitem__(self, name: str) -> Any:
        return self._loaders[name]()

    def __iter__(self) -> Iterator[str]:
        return iter(self._loaders)

    def __len__(self) -> int:
        return len(self._loaders)


@cache
def _loaders() -> dict[str, Callable[[], Any]]:
    """Function that loads each command, once in a process."""
    package = importlib.import_module(__package__)
    own = {
        _command_name(module.name): cache(partial(_own, module.name))
        for module in pkgutil.iter_modules(package.__path__)
        if not module.name.startswith("_")
    }
    added = {entry.name: cache(partial(_added, entry)) for entry in entry_points(group=GROUP)}
    return dict(sorted((own | added).items()))


def _command_name(module: str) -> str:
    """Name of the command of a module."""
    return module.rstrip("_").replace("_", "-")


def _own(name: str) -> Any:
    module = importlib.import_module(f"{__package__}.{name}")
    # `import` is a keyword, so the file and the function are named `import_`.
    return _as_click(_command_name(name), getattr(module, name), getattr(module, "CONTEXT", None))


def _added(entry: EntryPoint) -> Any:
    try:
        return _as_click(entry.name, entry.load())
    except ImportError as reason:
        return _as_click(entry.name, _unavailable(entry.name, reason))


def _as_click(name: str, command: Any, context: dict[str, Any] | None = None) -> Any:
    """The click command, or click group, of a function or a Typer application."""
    app = typer.Typer(rich_markup_mode=PLAIN)
    app.callback()(lambda: None)
    if isinstance(command, typer.Typer):
        for part in command.registered_commands:
            part.cls = Command
        app.add_typer(command, name=name)
    else:
        app.command(name=name, cls=Command, context_settings=context)(command)
    return typer.main.get_command(app).commands[name]  # type: ignore[attr-defined]


def _unavailable(name: str, reason: ImportError) -> Callable[[], None]:
    """Replacement for a command that fails to import, so that the other commands keep working."""

    def command() -> None:
        fail(f"{name}: {reason}; run `planetary-twin doctor` for details")

    command.__doc__ = "Not available: see planetary-twin doctor."
    return command
