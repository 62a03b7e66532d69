"""What `make setup` does again, what it leaves alone, and how it refuses."""

import itertools
import os
import shutil
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

ROOT = Path(__file__).parents[2]


def make(*arguments, directory=ROOT, **environment):
    # The make that runs these tests is none of its business.
    outside = {key: value for key, value in os.environ.items() if "MAKE" not in key}
    return subprocess.run(
        ["make", *arguments],
        cwd=directory,
        env={**outside, **environment},
        capture_output=True,
        text=True,
        timeout=600,
    )


@pytest.fixture
def fresh(tmp_path):
    """The part of a fresh clone that set-up reads first."""
    shutil.copytree(ROOT / "tools", tmp_path / "tools")
    for name in ("Makefile", "requirements.lock", "pyproject.toml"):
        shutil.copy(ROOT / name, tmp_path)
    (tmp_path / "ros_ws/src/planetary_twin").mkdir(parents=True)
    return tmp_path


def assert_refused_in_one_line(result, directory, *words):
    assert result.returncode != 0
    lines = (result.stdout + result.stderr).strip().splitlines()
    assert len(lines) == 1, lines
    for word in words:
        assert word in lines[0]
    assert not (directory / ".venv").exists()


def test_second_setup_does_nothing():
    make("setup")
    result = make("setup")
    assert result.returncode == 0
    assert "Nothing to be done" in result.stdout


@pytest.mark.parametrize(
    ("changed", "steps"),
    [
        ("msgs_spec/msg/GearboxState.msg", {"tools/build_interfaces"}),
        ("ros_ws/src/planetary_twin/setup.py", {"tools/install_nodes"}),
        ("planetary_twin_py/core/model/train.hpp", {"tools/build_core"}),
        ("planetary_twin_py/model/train.py", set()),
        (
            "requirements.lock",
            {
                "tools/make_venv",
                "tools/install_model",
                "tools/build_interfaces",
                ".venv/bin/uv",
                "tools/build_core",
                "tools/install_nodes",
            },
        ),
        ("README.md", set()),
    ],
)
def test_a_change_repeats_only_the_steps_that_read_it(changed, steps):
    make("setup")
    result = make("--dry-run", f"--what-if={changed}", "setup")
    commands = {line.split()[0] for line in result.stdout.splitlines()}
    assert commands - {"mkdir", "touch", "make:"} == steps


def test_what_a_run_does_not_need_is_compiled_after_it():
    make("setup")
    changed = "--what-if=planetary_twin_py/core/model/train.hpp"
    lines = make("--dry-run", changed, "run").stdout.splitlines()
    (run,) = (i for i, line in enumerate(lines) if line.endswith("bin/planetary-twin run "))
    assert compiled(lines[:run]) == ["held_axes"]
    assert lines[run + 1].endswith(" setup")  # a change is what-if for this make alone
    whole = make("--dry-run", changed, "setup").stdout.splitlines()
    assert compiled(whole) == ["held_axes", "rest"]


def compiled(lines):
    return [line.split()[-1] for line in lines if line.startswith("tools/build_core")]


def test_unsupported_python_is_refused_in_one_line(fresh):
    old = fresh / "python3.10"
    posed = 'import sys, runpy; sys.version_info = (3, 10); runpy.run_path("tools/check_python.py")'
    old.write_text(f"#!/bin/sh\n[ \"$1\" = -c ] || exec {sys.executable} -c '{posed}'\n")
    old.chmod(0o755)
    result = make("setup", f"PYTHON={old}", directory=fresh)
    assert_refused_in_one_line(result, fresh, "3.11, 3.12 or 3.13", "python3.10")


@pytest.mark.parametrize(("variable", "language"), [("CC", "C "), ("CXX", "C++20 ")])
def test_missing_compiler_is_refused_in_one_line(fresh, variable, language):
    result = make("setup", directory=fresh, **{variable: "/nonexistent/compiler"})
    assert_refused_in_one_line(result, fresh, language + "compiler", variable, "apt install")


def test_lock_names_no_registry_and_hashes_every_package():
    lines = (ROOT / "requirements.lock").read_text().splitlines()
    assert not [line for line in lines if "://" in line or line.startswith("-")]
    packages = [line for line in lines if not line.startswith(" ")]
    assert len(packages) > 100
    assert all(line.endswith("\\") for line in packages)


def test_lock_covers_every_requirement():
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    groups = [project["dependencies"], *project["optional-dependencies"].values()]
    lines = (ROOT / "requirements.lock").read_text().splitlines()
    locked = {}
    for line in lines:
        if not line.startswith(" "):
            name, version = line.split(" ")[0].split("==")
            locked.setdefault(canonicalize_name(name), []).append(version)
    for requirement in map(Requirement, itertools.chain(*groups)):
        versions = locked.get(canonicalize_name(requirement.name), [])
        assert versions, f"{requirement} is not locked: run make lock"
        assert all(requirement.specifier.contains(version) for version in versions), requirement
