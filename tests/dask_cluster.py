"""A Dask scheduler with workers, each a process of this machine."""

import re
import subprocess
import sys
import time
from contextlib import contextmanager

DASK = [sys.executable, "-m", "dask"]
LOCAL = ["--host", "127.0.0.1", "--no-dashboard"]


@contextmanager
def local_cluster(folder, workers=2):
    """Address of a scheduler, and its workers; `folder` gets their files."""
    log = (folder / "scheduler.log").open("w+")
    processes = [
        subprocess.Popen([*DASK, "scheduler", *LOCAL, "--port", "0"], stdout=log, stderr=log)
    ]
    try:
        address = until(
            lambda: re.search(r"tcp://127\.0\.0\.1:\d+", (folder / log.name).read_text())
        )[0]
        for _ in range(workers):
            command = [*DASK, "worker", address, *LOCAL, "--nthreads", "1", "--no-nanny"]
            own = ["--local-directory", str(folder)]
            processes.append(subprocess.Popen([*command, *own], stdout=log, stderr=log))
        yield address, processes[1:]
    finally:
        for process in processes:
            process.kill()
            process.wait()
        log.close()


def until(found, timeout=60.0):
    """The first result of `found` that is true."""
    deadline = time.monotonic() + timeout
    while not (result := found()):
        assert time.monotonic() < deadline
        time.sleep(0.05)
    return result
