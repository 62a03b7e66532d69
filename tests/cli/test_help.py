"""The help of every command shows units, and an example that can be typed."""

import shlex
from importlib.metadata import version

import pytest
from typer.core import TyperGroup
from typer.main import get_command
from typer.testing import CliRunner

from planetary_twin_py.cli import build_app

APP = build_app()


def commands(group, *path):
    """All commands with the words that call them."""
    for name, command in group.commands.items():
        if isinstance(command, TyperGroup):
            yield from commands(command, *path, name)
        else:
            yield (*path, name), command


ALL = dict(commands(get_command(APP)))


def shown(*words):
    done = CliRunner().invoke(APP, [*words, "--help"], env={"COLUMNS": "80"})
    assert done.exit_code == 0, done.output
    return done.output


def test_commands_of_both_packages_are_there():
    assert {("simulate",), ("run",), ("param", "set"), ("bench-live",)} <= set(ALL)
    for words in ALL:
        assert f"\n  {words[0]} " in shown()


@pytest.mark.parametrize("words", ALL, ids=" ".join)
def test_every_example_is_shown_as_typed_and_accepted(words):
    output = shown(*words)
    typed = output.partition("\nExample:\n")[2].replace("\\\n", " ")
    assert "\n" not in typed.strip()
    program, *rest = shlex.split(typed)
    assert program == "planetary-twin" and tuple(rest[: len(words)]) == words
    ALL[words].make_context(words[-1], rest[len(words) :])


def test_a_run_offers_only_fields_that_it_can_set():
    assert "mesh.ramp" in shown("simulate")
    assert "operating point" in shown("run") and "mesh.ramp" not in shown("run")


def test_a_mistyped_command_is_answered_with_a_similar_one():
    done = CliRunner().invoke(APP, ["simulte"])
    assert done.exit_code == 2 and "'simulate'" in done.output


def test_the_version_is_that_of_the_package():
    done = CliRunner().invoke(APP, ["--version"])
    assert done.exit_code == 0 and done.output.strip() == version("planetary_twin_py")
