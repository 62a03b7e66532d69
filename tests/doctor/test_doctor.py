"""The doctor distinguishes sound, absent and broken parts, and says how to fix them."""

import json
from importlib.metadata import entry_points
from pathlib import Path

import pytest
from command_line import invoke, succeed

from planetary_twin_py import _core
from planetary_twin_py.cli import _commands
from planetary_twin_py.cli._commands import GROUP
from planetary_twin_py.doctor import apart, core, disk, environment, packages, viewer
from planetary_twin_py.doctor.finding import Finding


def by_part(findings):
    return {finding.part: finding for finding in findings}


def test_missing_packages_are_named_with_their_extra(monkeypatch):
    known = packages.version
    missing = {"rerun-sdk", "pyarrow"}

    def version(name):
        if name in missing:
            raise packages.PackageNotFoundError(name)
        return known(name)

    assert {f.state for f in packages.check()} == {"sound"}
    monkeypatch.setattr(packages, "version", version)
    found = by_part(packages.check())
    for extra, package in (("view", "rerun-sdk"), ("analysis", "pyarrow"), ("studies", "pyarrow")):
        assert found[extra].state == "absent" and package in found[extra].details
        assert f"[{extra}]" in found[extra].fix
    assert found["recording"].state == found["plots"].state == "sound"


def test_every_extra_of_an_installation_is_checked():
    extras = set(packages.EXTRAS)
    project = Path(__file__).parents[2] / "pyproject.toml"
    import tomllib

    declared = set(tomllib.loads(project.read_text())["project"]["optional-dependencies"])
    assert declared - extras == {"ros", "build", "docs", "test", "bench"}


def test_a_core_that_is_missing_or_slow_is_reported(monkeypatch):
    (found,) = core.check()
    assert found.state == "sound" and _core.SOURCES in found.details
    monkeypatch.setattr(_core, "LEVEL", "v1")
    monkeypatch.setattr(_core, "runnable_levels", lambda: ["v3", "v1"])
    (found,) = core.check()
    assert found.state == "sound" and "slower than x86-64-v3" in found.details and found.fix

    def without_axes(name):
        if name.endswith(".axes"):
            raise ImportError("not built")
        return _core

    monkeypatch.setattr(core, "import_module", without_axes)
    _, found = core.check()
    assert (found.part, found.state, found.fix) == ("moving axes", "absent", "make setup")

    def missing(name):
        raise ImportError("not built")

    monkeypatch.setattr(core, "import_module", missing)
    (found,) = core.check()
    assert found.state == "broken" and found.details == "not built" and "make setup" in found.fix


def test_a_folder_without_room_or_rights_is_broken(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (found,) = disk.check()
    assert found.state == "sound" and str(tmp_path) in found.details
    monkeypatch.setattr(disk, "_ENOUGH", 1e12)
    assert [f.state for f in disk.check()] == ["broken"]
    monkeypatch.setattr(disk.os, "access", lambda *_: False)
    (found,) = disk.check()
    assert found.state == "broken" and "is not writable" in found.details


def test_a_viewer_that_does_not_start_is_broken(tmp_path, monkeypatch):
    fake = tmp_path / "rerun"
    fake.write_text("#!/bin/sh\necho no such library >&2\nexit 127\n")
    fake.chmod(0o755)
    monkeypatch.setattr("planetary_twin_py.view.viewer.BINARY", fake)
    assert [*viewer.check()] == [
        Finding("viewer", "broken", "no such library", "pip install --force-reinstall rerun-sdk")
    ]


@pytest.mark.parametrize("name", ["VK_DRIVER_FILES", "VK_ICD_FILENAMES"])
def test_a_graphics_driver_named_in_the_environment_is_found(tmp_path, monkeypatch, name):
    for variable in ("VK_DRIVER_FILES", "VK_ICD_FILENAMES"):
        monkeypatch.delenv(variable, raising=False)
    driver = tmp_path / "lvp_icd.x86_64.json"
    driver.touch()
    for given in (driver, tmp_path):
        monkeypatch.setenv(name, f"/nowhere/other.json:{given}")
        assert viewer._driver() == Finding("graphics", "sound", "lvp_icd.x86_64")
    monkeypatch.setenv(name, "/nowhere/other.json")
    missing = viewer._driver()
    assert missing.state == "absent" and f"{name} = /nowhere/other.json" in missing.details


@pytest.mark.slow
def test_this_installation_is_sound(tmp_path):
    file = tmp_path / "found.json"
    succeed("doctor", "--json", file)
    found = {entry["part"]: entry for entry in json.loads(file.read_text())}
    assert {"python", "model", "core", "disk", "viewer", "ros", "shared memory"} <= set(found)
    assert found["middleware"]["state"] == "sound" and "arrived" in found["middleware"]["told"]


def test_a_middleware_that_crashes_does_not_end_the_doctor(monkeypatch):
    monkeypatch.setenv("RMW_IMPLEMENTATION", "rmw_of_no_one")
    (found,) = apart.check()
    assert (found.part, found.state) == ("ros", "broken")
    assert "rmw_of_no_one" in found.details and "RMW_IMPLEMENTATION" in found.fix


def test_another_sourced_distribution_is_reported(monkeypatch):
    monkeypatch.setenv("ROS_DISTRO", "jazzy")
    assert [*environment.check()] == []
    monkeypatch.setenv("ROS_DISTRO", "humble")
    (found,) = environment.check()
    assert found.state == "broken" and "humble" in found.details


def test_a_command_that_cannot_be_loaded_affects_no_other(monkeypatch):
    (entry,) = entry_points(group=GROUP, name="run")

    def broken(_):
        raise ImportError("librcl.so: cannot open shared object file")

    monkeypatch.setattr(type(entry), "load", broken)
    monkeypatch.setattr(_commands, "_loaders", _commands._loaders.__wrapped__)  # loaded here
    done = invoke("run")
    assert done.exit_code == 2
    assert "librcl.so" in done.output
    assert done.output.strip().endswith("run `planetary-twin doctor` for details")
    assert invoke("modal", "--help").exit_code == 0


def test_missing_packages_are_listed_without_markers(monkeypatch):
    monkeypatch.setattr(packages, "_installed", lambda need: False)
    found = {finding.part: finding for finding in packages.check()}
    assert found["plots"].details == "to draw plots: missing matplotlib"
    assert not any(";" in finding.details for finding in found.values())
