"""A command of a package that is not installed is refused with what it needs."""

from importlib.metadata import entry_points

import pytest
from command_line import invoke

from planetary_twin_py.cli import _commands

MISSING = [*_commands.OF_NODES, *_commands.OF_BENCHMARKS]


def test_commands_of_other_packages_are_their_entry_points():
    assert sorted(MISSING) == sorted(entry.name for entry in entry_points(group=_commands.GROUP))


@pytest.mark.parametrize("name", MISSING)
def test_a_command_that_is_not_installed_names_what_it_needs(name, monkeypatch):
    monkeypatch.setattr(_commands, "entry_points", lambda group: ())
    monkeypatch.setattr(_commands, "_loaders", _commands._loaders.__wrapped__)  # looked up here
    done = invoke(name, "--help")
    part = "ROS nodes" if name in _commands.OF_NODES else "benchmarks"
    assert done.exit_code == 2 and len(done.stderr.splitlines()) == 1
    assert f"{name}: needs the {part}" in done.stderr and "docs/installing.md" in done.stderr
