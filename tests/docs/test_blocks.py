"""Every block of the documentation works as written.

Each page is executed from top to bottom in a separate folder, with a small recording as
`recordings/NAME`: Python in one namespace, commands in a shell, files under their names. What
follows a command on the page is an excerpt of what the command prints.
"""

import shutil
import subprocess

import pytest
from docs.blocks import LANGUAGES, REASONS, ROOT, blocks, pages
from docs.trial import TIMEOUT, changes_code, end, readers_environment, tried, try_block

PAGES = pages()
RECORDED = 2.0  # [s] of recordings/NAME
LONG = "docs/gallery.md", "docs/howto/fit.md"  # more than a minute of processor time

pytestmark = pytest.mark.slow


def name(page):
    return str(page.relative_to(ROOT))


@pytest.fixture(scope="session")
def environment():
    with readers_environment() as found:
        yield found


@pytest.fixture(scope="session")
def recording(tmp_path_factory, environment):
    folder = tmp_path_factory.mktemp("recorded")
    command = f"planetary-twin simulate paper --duration {RECORDED} --out NAME"
    subprocess.run(command, shell=True, cwd=folder, env=environment, check=True, timeout=TIMEOUT)
    return folder / "NAME"


@pytest.mark.parametrize("page", PAGES, ids=name)
def test_every_block_states_its_language_and_why_it_is_not_run(page):
    for block in blocks(page):
        reason = block.word("not-run")
        assert reason is None or reason in REASONS, f"{block}: {reason}"
        assert block.language in LANGUAGES, f"{block}: {block.language!r}"
        assert block.language != "console" or block.commands, f"{block}: no line begins with '$ '"


@pytest.mark.exhaustive
@pytest.mark.parametrize(
    "page",
    [
        pytest.param(page, id=name(page), marks=pytest.mark.release if name(page) in LONG else ())
        for page in PAGES
        if not changes_code(page)
    ],
)
def test_page(page, tmp_path, recording, environment, monkeypatch):
    shutil.copytree(recording, tmp_path / "recordings" / "NAME")
    for part in ("tests/data", "docs/examples"):
        shutil.copytree(ROOT / part, tmp_path / part)
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("MPLBACKEND", "Agg")
    behind, namespace = [], {"__name__": "__main__"}
    try:
        for block in tried(page):
            try_block(block, tmp_path, environment, namespace, behind)
    finally:
        left = [end(process) for process in behind]
    assert not any(left), left
