"""The commands by their names, each loaded when it is asked for."""

from __future__ import annotations

import importlib
import pkgutil
from collections.abc import Callable, Iterator, Mapping
from functools import partial
from importlib.metadata import EntryPoint, entry_points
from typing import Any

import typer
from typer.core import TyperGroup

from ._fail import fail
from ._help import PLAIN, Command

GROUP = "planetary_twin.commands"
_SENTENCE = 300  # characters at most


class Group(TyperGroup):
    """A group that knows the names of its commands, and makes a command on first use."""

    def __init__(self, **attributes: Any) -> None:
        super().__init__(**attributes)
        self.commands: Mapping[str, Any] = Commands()  # type: ignore[assignment]

    def list_commands(self, ctx: Any) -> list[str]:
        """Return names alone: Typer's own would load every command for them."""
        return list(self.commands)

    def format_commands(self, ctx: Any, formatter: Any) -> None:
        """Write each command with the whole first sentence of its help."""
        rows = [
            (name, command.get_short_help_str(_SENTENCE)) for name, command in self.commands.items()
        ]
        with formatter.section("Commands"):
            formatter.write_dl(rows)


class Commands(Mapping[str, Any]):
    """What is installed: the commands of this package, and those of entry points."""

    def __init__(self) -> None:
        package = importlib.import_module(__package__)
        own = {
            module.name.rstrip("_"): partial(_own, module.name)
            for module in pkgutil.iter_modules(package.__path__)
            if not module.name.startswith("_")
        }
        added = {entry.name: partial(_added, entry) for entry in entry_points(group=GROUP)}
        self._loaders: dict[str, Callable[[], Any]] = dict(sorted((own | added).items()))

    def __getitem__(self, name: str) -> Any:
        return self._loaders[name]()

    def __iter__(self) -> Iterator[str]:
        return iter(self._loaders)

    def __len__(self) -> int:
        return len(self._loaders)


def _own(name: str) -> Any:
    module = importlib.import_module(f"{__package__}.{name}")
    # A file and a function cannot be called `import`, so an underscore follows.
    return _made(name.rstrip("_"), getattr(module, name), getattr(module, "CONTEXT", None))


def _added(entry: EntryPoint) -> Any:
    try:
        return _made(entry.name, entry.load())
    except ImportError as reason:
        return _made(entry.name, _out_of_order(entry.name, reason))


def _made(name: str, command: Any, context: dict[str, Any] | None = None) -> Any:
    """The command, or the group of commands, as what Typer makes of it."""
    app = typer.Typer(rich_markup_mode=PLAIN)
    app.callback()(lambda: None)
    if isinstance(command, typer.Typer):
        for part in command.registered_commands:
            part.cls = Command
        app.add_typer(command, name=name)
    else:
        app.command(name=name, cls=Command, context_settings=context)(command)
    return typer.main.get_command(app).commands[name]  # type: ignore[attr-defined]


def _out_of_order(name: str, reason: ImportError) -> Callable[[], None]:
    """A command that cannot be loaded must not take the others, and the doctor, with it."""

    def command() -> None:
        fail(f"{name}: {reason}; planetary-twin doctor tells more")

    command.__doc__ = "Out of order: see planetary-twin doctor."
    return command
