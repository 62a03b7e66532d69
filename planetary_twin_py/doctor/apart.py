"""Checks that other packages add, each in a process of its own.

Where ROS is out of order, loading it may end the process; the doctor goes on and says so.
"""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Iterator
from importlib.metadata import entry_points

from .finding import Finding

GROUP = "planetary_twin.checks"
_PATIENCE = 8.0  # [s]
_MEND = "check RMW_IMPLEMENTATION, and that no other ROS 2 is sourced; or make setup"


def check() -> Iterator[Finding]:
    """What is found by each, or why it found nothing."""
    names = sorted(entry.name for entry in entry_points(group=GROUP))
    if not names:
        mend = "see 'Where ROS 2 Jazzy is installed' in the README"
        yield Finding("nodes", "absent", "the package planetary_twin is not installed", mend)
    for name in names:
        yield from _ask(name)


def _ask(name: str) -> Iterator[Finding]:
    command = [sys.executable, "-m", __name__, name]
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=_PATIENCE)
    except subprocess.TimeoutExpired:
        yield Finding(name, "broken", f"no answer within {_PATIENCE:g} s", _MEND)
        return
    if done.returncode:
        reasons = done.stderr.strip().splitlines() or [f"exit code {done.returncode}"]
        yield Finding(name, "broken", reasons[-1], _MEND)
        return
    yield from (Finding(*found) for found in json.loads(done.stdout.splitlines()[-1]))


def main(name: str) -> None:
    """Print as one line of JSON what the check `name` finds."""
    (entry,) = entry_points(group=GROUP, name=name)
    print(json.dumps([*entry.load()()]))


if __name__ == "__main__":
    main(sys.argv[1])
