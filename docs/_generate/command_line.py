"""The command line, from the Typer application."""

import re
from collections import Counter
from collections.abc import Mapping
from textwrap import fill

import typer
from typer.cli import get_docs_for_click

from planetary_twin_py.analysis.gears.indicators import ConditionIndicators
from planetary_twin_py.cli import build_app
from planetary_twin_py.explanation.meshes import MeshFigures
from planetary_twin_py.units.catalogue import MESH, Quantity
from planetary_twin_py.units.shown import (
    AXES_OF_RUN,
    ORDERS,
    RUN,
    SHARES_OF_RUN,
    key_with_unit,
    quantities_of,
)

_MANY = 3
"""What is the same in so many commands is explained once, although its name has several texts."""
_OPTION = re.compile(r"^\* `(?P<name>[^`]+)`: .*\n", re.MULTILINE)
_USAGE = re.compile(r"\*\*Usage\*\*:\n\n```console\n\$ (.*)\n```\n")
_HEAD = """# Command line

Generated from the application that `planetary-twin --help` shows. `[SCENE]` may be left out,
`{SCENE}` may not.

"""
_COMMON = """
## Options of several commands

A command below names those that it has. `--help` shows the explanations of all options.

"""


def _keyed(quantities: Mapping[str, Quantity]) -> dict[str, Quantity]:
    return {key_with_unit(name, quantity): quantity for name, quantity in quantities.items()}


_FIGURES = {
    "simulate": {
        "": _keyed(RUN),
        "`sun_planet` and `planet_ring`": _keyed(MESH),
        "of each body, where axes move": _keyed(AXES_OF_RUN),
        "of each planet, where axes move": _keyed(SHARES_OF_RUN),
    },
    "explain": {
        "`meshes`, of `sun_planet` and `planet_ring`, in SI": quantities_of(MeshFigures),
    },
    "faults": {
        "`orders`, each with `order`, `exact` and `frequency_hz`": ORDERS,
    },
    "indicators": {
        "`indicators`, each with `value`, `low`, `high` and `reason`": quantities_of(
            ConditionIndicators
        ),
    },
}
"""Figures of `--json` by command and by their place."""


def page() -> str:
    """Options of several commands, then a section for every command."""
    application = typer.main.get_command(build_app())
    context = typer.Context(application, info_name="planetary-twin")
    text = get_docs_for_click(obj=application, ctx=context, name="planetary-twin")
    # Lists of commands are left out: the sections have the same sentences.
    text = re.sub(r"\*\*Commands\*\*:\n\n(\* .*\n)+", "", text)
    first, *commands = re.split(r"^##+ .*\n", text.split("\n", 1)[1], flags=re.MULTILINE)
    lines = [match for command in commands for match in _OPTION.finditer(command)]
    counts = Counter(line[0] for line in lines)
    several = {(line["name"], line[0]) for line in lines if counts[line[0]] > 1}
    texts = Counter(name for name, _ in several)
    single = {name for name, count in texts.items() if count == 1 and name.startswith("--")}
    many = {
        line[0] for line in lines if counts[line[0]] >= (2 if line["name"] in single else _MANY)
    }
    named = sorted(many)
    return (
        _HEAD
        + _words(first)
        + "\n"
        + "".join(match[0] for match in _OPTION.finditer(first))
        + _COMMON
        + "".join(line for line in named if "`--help`" not in line)
        + "".join(_section(command, many) for command in commands)
    )


def _section(command: str, many: set[str]) -> str:
    """Usage, words, own arguments and options, and names of those that are explained above."""
    usage = _USAGE.search(command)
    assert usage is not None
    found = list(_OPTION.finditer(command))
    rows = [match[0] for match in found if match[0] not in many]
    names = [match["name"].split()[0] for match in found if match[0] in many]
    also = ", ".join(f"`{name}`" for name in names if name.startswith("--") and name != "--help")
    rows += [f"* also {also}\n"] if also else []
    listed = "\n" + "".join(rows) if rows else ""
    name = usage[1].split()[1]
    return f"\n## `{usage[1].replace(' [OPTIONS]', '')}`\n\n{_words(command)}{listed}" + "".join(
        _figures(place, keys) for place, keys in _FIGURES.get(name, {}).items()
    )


def _figures(place: str, quantities: Mapping[str, Quantity]) -> str:
    """Keys of `--json` with their units, and what they are if the keys do not say it."""
    where = f", {place}" if place else ""
    text = "; ".join(_figure(key, quantity) for key, quantity in quantities.items())
    whole = f"Figures of `--json`{where}: {text}."
    return "\n" + fill(whole, 100, break_on_hyphens=False) + "\n"


def _figure(key: str, quantity: Quantity) -> str:
    unit = f" [{quantity.si}]" if quantity.si else ""
    text = quantity.text.removeprefix("- ")
    return f"`{key}`{unit}" + (f" {text}" if text.replace(" ", "_") != key else "")


def _words(command: str) -> str:
    """What a command prints as help besides usage, arguments and options."""
    text = _OPTION.sub("", _USAGE.sub("", command))
    text = re.sub(r"^\*\*(Arguments|Options)\*\*:\n", "", text, flags=re.MULTILINE)
    return re.sub(r"\n{3,}", "\n\n", text).strip() + "\n"
