"""The site builds without a warning: no broken link, no missing picture, no unlisted page."""

import re
import runpy
import subprocess
import sys
from pathlib import Path

import pytest

import planetary_twin_py as pt

ROOT = Path(__file__).parents[2]


@pytest.fixture(scope="module")
def build(tmp_path_factory):
    """The finished build of the site, and its folder."""
    folder = tmp_path_factory.mktemp("site")
    command = [Path(sys.executable).with_name("sphinx-build"), "--quiet", "--fail-on-warning"]
    done = subprocess.run(
        [*command, "--keep-going", "-d", folder / "trees", ROOT / "docs", folder / "site"],
        capture_output=True,
        text=True,
        timeout=1200,
    )
    return done, folder / "site"


@pytest.mark.exhaustive
def test_site_is_built_without_a_warning(build):
    done, site = build
    assert done.returncode == 0, done.stdout + done.stderr
    assert (site / "index.html").exists()


@pytest.mark.exhaustive
def test_pages_load_nothing_from_a_network(build):
    _, site = build
    for page in site.rglob("*.html"):
        loaded = re.findall(r'<(?:script|img|iframe)[^>]*src="(http[^"]*)"', page.read_text())
        loaded += re.findall(r'<link[^>]*rel="stylesheet"[^>]*href="(http[^"]*)"', page.read_text())
        assert not loaded, page
    for page, least in {"model": 120, "lubrication": 90, "symbols": 80}.items():
        assert (site / f"{page}.html").read_text().count("<math") > least


def test_reference_names_every_public_object():
    page = (ROOT / "docs/reference/python.md").read_text()
    named = ["TUNABLES", *re.findall(r"^\.\. auto\w+:: (\w+)$", page, re.MULTILINE)]
    assert sorted(named) == sorted(pt.__all__)


def test_pages_of_the_reference_are_the_generated_ones(tmp_path):
    # In a separate process, because it changes the environment for the nodes that it starts.
    make = [sys.executable, "-m", "_generate", tmp_path]
    subprocess.run(make, cwd=ROOT / "docs", check=True, timeout=600)
    made = {file.name: file.read_text() for file in tmp_path.iterdir()}
    kept = {name: (ROOT / "docs/reference" / name).read_text() for name in made}
    assert len(made) == 6
    assert kept == made, "make docs writes them"


def test_picture_of_the_architecture_is_the_generated_one():
    drawn = runpy.run_path(str(ROOT / "docs/_generate/architecture.py"))["picture"]()
    assert (ROOT / "docs/architecture.svg").read_text() == drawn
    assert all((ROOT / "planetary_twin_py" / folder).exists() for folder in folders(drawn))


def folders(drawn):
    """The folders of the package that the picture names."""
    titles = re.findall(r'font-weight="bold">([^<]*)<', drawn)
    return [name for title in titles for name in title.split() if not name.startswith("ros_ws")]
