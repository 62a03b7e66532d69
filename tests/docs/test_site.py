"""The site is built without a warning: no broken link, no missing picture, no page left over."""

import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]


@pytest.mark.slow
def test_site_is_built_without_a_warning(tmp_path):
    build = [Path(sys.executable).with_name("sphinx-build"), "--quiet", "--fail-on-warning"]
    done = subprocess.run(
        [*build, "--keep-going", "-d", tmp_path / "trees", ROOT / "docs", tmp_path / "site"],
        capture_output=True,
        text=True,
        timeout=200,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    assert (tmp_path / "site/index.html").exists()
