"""The model as a wheel: what is in it, and that it works alone. Building it takes minutes."""

import email
import tarfile
import tomllib
import zipfile
from pathlib import Path

import pytest
from packaging.requirements import Requirement
from setup.wheels import ROOT, build_source_archive, build_wheel, unpack_wheel, without_extras

from planetary_twin_py._core.levels import ARM, X86_64, runnable_levels

CONFIGURATION = tomllib.loads((ROOT / "pyproject.toml").read_text())
BEST = runnable_levels()[0]
pytestmark = [pytest.mark.exhaustive, pytest.mark.slow]
NOT_THE_MODELS = ("ros", "rclpy", "rerun", "mcap", "matplotlib", "pyarrow", "distributed", "sundae")


@pytest.fixture(scope="module")
def archive(tmp_path_factory):
    return build_source_archive(tmp_path_factory.mktemp("wheel"))


@pytest.fixture(scope="module")
def wheel(archive):
    return build_wheel(archive, [BEST])


@pytest.fixture(scope="module")
def alone(wheel, tmp_path_factory):
    return unpack_wheel(wheel, tmp_path_factory.mktemp("installed"))


def test_the_source_archive_has_sources_and_no_compiled_files(archive):
    with tarfile.open(archive) as opened:
        held = {name.partition("/")[2] for name in opened.getnames()}
    core = (ROOT / "planetary_twin_py/core").rglob("*.?pp")
    assert {str(file.relative_to(ROOT)) for file in core} <= held
    assert not [name for name in held if name.endswith((".so", ".pyi", ".pyc"))]


def levels_in(names):
    return {Path(name).name.split(".")[0] for name in names if name.endswith(".so")}


def test_the_wheel_holds_the_core_and_its_stub_but_no_source(wheel):
    held = zipfile.ZipFile(wheel).namelist()
    core = [name for name in held if name.startswith("planetary_twin_py/_core/")]
    of_fmus = [name for name in core if name.startswith("planetary_twin_py/_core/fmu/")]
    of_axes = [name for name in core if name.startswith("planetary_twin_py/_core/axes/")]
    assert levels_in(set(core) - set(of_fmus) - set(of_axes)) == {BEST}
    assert levels_in(of_axes) == {BEST}
    assert levels_in(of_fmus) == {BEST, "fmi"}
    assert {f"planetary_twin_py/_core/{name}__init__.pyi" for name in ("", "axes/")} <= set(core)
    assert not [name for name in held if name.endswith((".hpp", ".cpp", "CMakeLists.txt"))]
    assert "-none-" not in wheel.name


def test_a_wheel_is_built_for_every_level():
    builds = CONFIGURATION["tool"]["scikit-build"]
    (on_arm,) = builds["overrides"]
    for build, levels in ((builds, X86_64), (on_arm, ARM)):
        assert set(build["cmake"]["define"]["LEVELS"].split(";")) == set(levels)


def test_the_wheel_holds_the_package_and_what_it_reads(wheel):
    held = set(zipfile.ZipFile(wheel).namelist())
    kept = ROOT / "planetary_twin_py"
    needed = {
        str(file.relative_to(ROOT))
        for pattern in ("**/*.py", "scene/packaged/*.yaml", "recording/ros2/msg/*.msg", "py.typed")
        for file in kept.glob(pattern)
        if not file.is_relative_to(kept / "core")
    }
    needed |= {
        f"planetary_twin_py/recording/ros2/msg/{m.name}" for m in ROOT.glob("msgs_spec/msg/*")
    }
    assert "planetary_twin_py/py.typed" in needed and len(needed) > 300
    assert needed <= held
    assert {name.split("/")[0].split("-")[0] for name in held} == {"planetary_twin_py"}
    assert not [name for name in held if "test" in name]
    assert [name for name in held if name.endswith("licenses/LICENSE")]


def test_the_model_alone_asks_for_no_ros_and_no_viewer(wheel):
    with zipfile.ZipFile(wheel) as held:
        (name,) = (name for name in held.namelist() if name.endswith("METADATA"))
        metadata = email.message_from_bytes(held.read(name))
    needs = [Requirement(text) for text in metadata.get_all("Requires-Dist")]
    alone = [need.name for need in needs if need.marker is None]
    assert {"numpy", "scipy", "typer"} <= set(alone)
    assert not [need for need in alone if any(word in need.lower() for word in NOT_THE_MODELS)]
    assert {"ros", "view", "studies"} <= set(metadata.get_all("Provides-Extra"))


def test_the_model_alone_simulates(alone):
    done = without_extras(
        alone,
        "import planetary_twin_py as pt\n"
        "print(pt.simulate(pt.load_scene('paper'), duration=0.01).efficiency)",
    )
    assert done.returncode == 0, done.stderr
    assert 0.5 < float(done.stdout) < 1.0


def test_the_package_is_imported_without_the_core(alone):
    core = "planetary_twin_py._core"
    heavy = f"[m for m in ({core!r}, 'numpy', 'scipy', 'pydantic', 'pint') if m in sys.modules]"
    done = without_extras(alone, f"print({heavy})")
    assert done.stdout.strip() == "[]", done.stderr


@pytest.mark.parametrize(
    ("typed", "extra"),
    [
        ("info x", "recording"),
        ("spectrum x.csv", "analysis"),
        ("view x", "view"),
        ("sweep paper --out x.csv", "studies"),
        ("modal --campbell x.png", "plots"),
        ("bench --peers", "bench"),
    ],
)
def test_a_command_names_the_extra_it_lacks(alone, typed, extra):
    done = without_extras(alone, "from planetary_twin_py.cli import main; main()", *typed.split())
    assert done.returncode == 2, done.stderr
    assert len(done.stderr.splitlines()) == 1
    assert f"pip install 'planetary_twin_py[{extra}]'" in done.stderr
