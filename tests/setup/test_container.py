"""The container is built, and runs, where something can build it.

CONTAINER_BASE names another base, for machines that reach no registry.
"""

import os
import re
import shutil
import subprocess
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
CONTAINERFILE = ROOT / "tools/Containerfile"
IMAGE = "localhost/planetary_twin_tests"
(BASE,) = re.findall(r"^ARG BASE=(.+)$", CONTAINERFILE.read_text("utf-8"), re.MULTILINE)
pytestmark = [pytest.mark.exhaustive, pytest.mark.slow]


def run(*command: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(command, cwd=ROOT, capture_output=True, text=True)


@pytest.fixture(scope="module")
def builder() -> str:
    for name in ("docker", "podman", "buildah"):
        if shutil.which(name) and run(name, "info").returncode == 0:
            return name
    pytest.skip("needs Docker, Podman or buildah")


@pytest.fixture(scope="module")
def image(builder: str) -> Iterator[str]:
    """The image, built on the base of the Containerfile or on the one that CONTAINER_BASE names."""
    base = os.environ.get("CONTAINER_BASE", BASE)
    if run(builder, "inspect", base).returncode and run(builder, "pull", base).returncode:
        pytest.skip(f"{builder} cannot get {base}")
    arguments = ("--build-arg", f"BASE={base}", "--file", str(CONTAINERFILE), "--tag", IMAGE, ".")
    built = run(builder, "build", *arguments)
    assert built.returncode == 0, (built.stdout + built.stderr)[-3000:]
    yield IMAGE
    run(builder, "rmi", "--force", IMAGE)


def test_a_run_in_the_container_records_every_message(builder: str, image: str) -> None:
    command = ("run", "--duration", "4", "--no-tour")
    if builder == "buildah":
        container = run(builder, "from", image).stdout.strip()
        done = run(builder, "run", container, "--", "planetary-twin", *command)
        run(builder, "rm", container)
    else:
        shared = ("--network", "host", "--ipc", "host")
        done = run(builder, "run", "--rm", *shared, image, *command)
    assert done.returncode == 0, done.stdout + done.stderr
    (counts,) = re.findall(r"gearbox_state +(\d+) +(\d+) +(\d+)", done.stdout)
    published, recorded, lost = map(int, counts)
    assert published == recorded > 100 and lost == 0
