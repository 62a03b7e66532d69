"""Builds the wheel as a release does, and runs it where nothing else is installed."""

import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

ROOT = Path(__file__).parents[2]
SOURCE = ROOT / "build" / "wheel"
COMPILED = SOURCE / "source"  # .ci/run names this path to its compiler cache
UV = [Path(sys.prefix, "bin/uv"), "--offline", "--quiet", "build", "--no-build-isolation",
      "--python", sys.executable]  # fmt: skip


def build_source_archive(folder):
    """A source archive in `folder` of the files that are kept."""
    listed = subprocess.run(
        ["git", "ls-files", "-co", "--exclude-standard"],
        cwd=ROOT, capture_output=True, text=True, check=True,
    )  # fmt: skip
    for name in listed.stdout.splitlines():
        if (ROOT / name).exists():
            (folder / "kept" / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(ROOT / name, folder / "kept" / name, follow_symlinks=False)
    subprocess.run([*UV, "--sdist", "--out-dir", folder, folder / "kept"], check=True)
    (archive,) = folder.glob("*.tar.gz")
    return archive


def build_wheel(archive, levels):
    """A wheel of `archive`, beside it, whose core is compiled for `levels`."""
    shutil.rmtree(SOURCE, ignore_errors=True)
    SOURCE.mkdir(parents=True)
    subprocess.run(["tar", "--extract", "--file", archive, "--directory", SOURCE], check=True)
    (unpacked,) = SOURCE.iterdir()
    unpacked = unpacked.rename(COMPILED)
    chosen = f"cmake.define.LEVELS={';'.join(levels)}"
    subprocess.run(
        [*UV, "--wheel", "--config-setting", chosen, "--out-dir", archive.parent, unpacked],
        check=True,
    )
    shutil.rmtree(SOURCE)
    (wheel,) = archive.parent.glob("*.whl")
    return wheel


def unpack_wheel(wheel, folder):
    """Put the wheel's files into `folder`, as pip does."""
    with zipfile.ZipFile(wheel) as opened:
        opened.extractall(folder)
    return folder


# `find_spec` and `import` take a module that is None for one that is not installed.
WITHOUT = """
import sys
sys.path.insert(0, {folder!r})
for name in ("rclpy", "rerun", "rerun_cli", "mcap", "rosbags", "matplotlib", "pyarrow",
             "distributed", "sksundae", "CyRK", "planetary_twin", "planetary_twin_msgs"):
    sys.modules[name] = None
import planetary_twin_py
assert planetary_twin_py.__file__.startswith({folder!r}), planetary_twin_py.__file__
"""


def without_extras(folder, code, *arguments):
    return subprocess.run(
        [sys.executable, "-c", WITHOUT.format(folder=str(folder)) + code, *arguments],
        capture_output=True,
        text=True,
        timeout=1200,
    )
