"""Every block of the documentation works as written.

Each page is executed from top to bottom in a separate folder, with a small recording as
`recordings/NAME`: Python in one namespace, commands in a shell, files under their names. What
follows a command on the page is an excerpt of what the command prints.
"""

import os
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
import yaml
from docs.blocks import LANGUAGES, REASONS, ROOT, Block, blocks, pages, shows
from domains import private_domain

import planetary_twin_py as pt

PAGES = pages()
RECORDED = 2.0  # [s] of recordings/NAME
TIMEOUT = 1200.0  # [s] longest time of a command; most take a few seconds
STARTS = 600.0  # [s] for the first output of a background command
ENDS = 120.0  # [s] for its end

pytestmark = pytest.mark.slow


def name(page):
    return str(page.relative_to(ROOT))


def changes_code(page):
    return any(block.language == "diff" for block in blocks(page))


@pytest.fixture(scope="session")
def environment():
    """The environment of a reader who has activated .venv, on a machine without a display."""
    outside = {key: value for key, value in os.environ.items() if key != "DISPLAY"}
    path = f"{Path(sys.executable).parent}:{os.environ['PATH']}"
    with private_domain() as number:
        own = {"PATH": path, "MPLBACKEND": "Agg", "COLUMNS": "200", "ROS_DOMAIN_ID": str(number)}
        yield outside | own | {"PYTHONUNBUFFERED": "1"}


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
@pytest.mark.parametrize("page", [page for page in PAGES if not changes_code(page)], ids=name)
def test_page(page, tmp_path, recording, environment, monkeypatch):
    shutil.copytree(recording, tmp_path / "recordings" / "NAME")
    shutil.copytree(ROOT / "tests" / "data", tmp_path / "tests" / "data")
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("MPLBACKEND", "Agg")
    behind, namespace = [], {"__name__": "__main__"}
    try:
        for block in tried(page):
            try_block(block, tmp_path, environment, namespace, behind)
    finally:
        left = [end(process) for process in behind]
    assert not any(left), left


@pytest.mark.exhaustive
def test_pages_that_change_the_package(environment):
    """All in one copy of the package, whose changes precede all other blocks: it compiles once."""
    folder = ROOT / "build" / "changed"  # a path that .ci/run gives to its cache of objects
    shutil.rmtree(folder, ignore_errors=True)
    ignored = shutil.ignore_patterns("__pycache__", "*.so")
    for part in ("planetary_twin_py", "tools"):
        shutil.copytree(ROOT / part, folder / part, ignore=ignored)
    here = {"PYTHONPATH": str(folder), "VIRTUAL_ENV": sys.prefix}
    here["GIT_CEILING_DIRECTORIES"] = str(folder.parent)  # a patch is for this copy
    changing = [block for page in PAGES if changes_code(page) for block in tried(page)]
    assert len({block.page for block in changing}) > 1
    for block in sorted(changing, key=lambda block: not makes_a_change(block)):
        try_block(block, folder, environment | here, {}, [])
    shutil.rmtree(folder)


def tried(page):
    return [block for block in blocks(page) if block.word("not-run") is None]


def makes_a_change(block):
    return block.word("file") is not None or any("git apply" in line for line in block.commands)


def try_block(block: Block, folder, environment, namespace, behind):
    if block.word("file"):
        (folder / block.word("file")).write_text(block.text)
    elif block.language == "python":
        exec(compile("\n" * block.line + block.text, str(block), "exec"), namespace)
    if block.language == "yaml":
        check_yaml(block)
    for command, output in block.session if block.language == "console" else ():
        if "background" in block.words:
            behind.append(start(command, folder, environment))
            continue
        done = subprocess.run(
            command, shell=True, cwd=folder, env=environment, capture_output=True, text=True,
            timeout=TIMEOUT,
        )  # fmt: skip
        assert done.returncode == 0, f"{block}: {command}\n{done.stdout}{done.stderr}"
        assert shows(output, done.stdout + done.stderr), (
            f"{block}: {command}\nshows\n{output}but prints\n{done.stdout}{done.stderr}"
        )


def check_yaml(block):
    """A scene, or a part of one, is a valid scene; parameters of nodes are valid YAML."""
    content = yaml.safe_load(block.text)
    if set(content) <= {"base", *pt.Scene.model_fields}:
        whole = "base" in content or "gearset" in content
        pt.parse_scene(block.text if whole else "base: paper\n" + block.text)


def start(command, folder, environment):
    """Start a background command, and wait for its first output."""
    log = folder / "background.log"
    process = subprocess.Popen(
        f"exec {command}", shell=True, cwd=folder, env=environment,
        stdout=log.open("w"), stderr=subprocess.STDOUT,
    )  # fmt: skip
    deadline = time.monotonic() + STARTS
    while not log.stat().st_size and process.poll() is None and time.monotonic() < deadline:
        time.sleep(0.05)
    assert process.poll() is None and log.stat().st_size, f"{command}\n{log.read_text()}"
    return process


def end(process):
    """Ctrl-C; returns the final output of the process."""
    if process.poll() is None:
        process.send_signal(signal.SIGINT)
    return process.wait(ENDS)


def test_an_excerpt_has_parts_in_their_order():
    printed = "one  2.41 s\n│ two   │ three │\nfour five\nsix"
    assert shows("one ... s\n...\nfour\nfive", printed) and shows("", printed)
    assert shows("│ two │ three │\nfour five", printed)
    for wrong in ("one 2.42 s", "four ... one", "two three", "one 2.41 s\nfour"):
        assert not shows(wrong, printed), wrong


@pytest.mark.parametrize("reason", REASONS)
def test_every_reason_is_in_use(reason):
    assert any(block.word("not-run") == reason for page in PAGES for block in blocks(page))
