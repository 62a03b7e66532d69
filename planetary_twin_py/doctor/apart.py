"""Checks that other packages add, each in a separate process.

Importing a broken ROS installation may end the process; the doctor then reports it and continues.
"""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Iterator
from importlib.metadata import entry_points

from .finding import Finding

GROUP = "planetary_twin.checks"
_TIMEOUT = 60.0  # [s], also where other programs keep the processor busy
_FIX = "check RMW_IMPLEMENTATION, and that no other ROS 2 is sourced; or run make setup"


def check() -> Iterator[Finding]:
    """Findings of each check, or the reason why a check failed."""
    names = sorted(entry.name for entry in entry_points(group=GROUP))
    if not names:
        fix = "make setup in a clone of the repository, see docs/installing.md"
        yield Finding("nodes", "absent", "the package planetary_twin is not installed", fix)
    for name in names:
        yield from _findings_of(name)


def _findings_of(name: str) -> Iterator[Finding]:
    command = [sys.executable, "-m", __name__, name]
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=_TIMEOUT)
    except subprocess.TimeoutExpired:
        yield Finding(name, "broken", f"no answer within {_TIMEOUT:g} s", _FIX)
        return
    if done.returncode:
        reasons = done.stderr.strip().splitlines() or [f"exit code {done.returncode}"]
        yield Finding(name, "broken", reasons[-1], _FIX)
        return
    yield from (Finding(*found) for found in json.loads(done.stdout.splitlines()[-1]))


def main(name: str) -> None:
    """Print the findings of the check `name` as one line of JSON."""
    (entry,) = entry_points(group=GROUP, name=name)
    print(json.dumps([*entry.load()()]))


if __name__ == "__main__":
    main(sys.argv[1])
