"""Which build of the core a scene runs on."""

import sys

import pytest
from typer.testing import CliRunner

from planetary_twin_py import _core, load_scene
from planetary_twin_py.cli import build_app
from planetary_twin_py.model.library import library


def test_axes_that_move_have_a_core_of_their_own():
    assert library(load_scene("paper")) is _core
    moving = library(load_scene("floating_sun"))
    assert moving.Model is not _core.Model and moving.SOURCES == _core.SOURCES


@pytest.fixture
def without_axes(monkeypatch):
    """A clone in which `make run` has not compiled yet what it does not need."""
    monkeypatch.delitem(sys.modules, "planetary_twin_py._core.axes", raising=False)
    monkeypatch.delattr(_core, "axes", raising=False)
    monkeypatch.setitem(sys.modules, f"planetary_twin_py._core.axes.{_core.LEVEL}", None)


def test_axes_that_move_wait_for_their_core_in_one_line(without_axes):
    done = CliRunner().invoke(build_app(), ["simulate", "floating_sun", "--duration", "0.01"])
    assert done.exit_code == 2
    assert "make setup" in done.output and "Traceback" not in done.output
    held = CliRunner().invoke(build_app(), ["simulate", "paper", "--duration", "0.01"])
    assert held.exit_code == 0
