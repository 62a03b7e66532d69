"""Execution by a Dask cluster, whose workers may join, leave or fail during the study."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from itertools import islice
from typing import Any

from .work import Answer, Failure, Task

AHEAD = 4  # points per thread of the cluster that run or are queued
_TIMEOUT = 30.0  # [s] for the scheduler to answer, and for its first worker


class Cluster:
    """The workers of a Dask scheduler.

    If a worker dies, another worker repeats its point; a point that kills several workers fails.
    All workers must have this version of the package, so that their results are identical.

    Args:
        address: address of the scheduler, e.g. "tcp://10.0.0.1:8786".

    Raises:
        ValueError: there is no scheduler, it has no workers, or a worker has another core.
    """

    def __init__(self, address: str) -> None:
        from distributed import Client

        try:
            self._client = Client(address, timeout=_TIMEOUT)
            self._client.wait_for_workers(1, timeout=_TIMEOUT)
        except (OSError, TimeoutError, ValueError) as reason:
            raise ValueError(f"scheduler = {address!r}: {reason}") from None
        own_digest = core_digest()
        for worker, digest in self._client.run(core_digest).items():
            if digest != own_digest:
                raise ValueError(
                    f"scheduler = {address!r}: worker {worker} has core {digest}, here "
                    f"{own_digest}; install the same version"
                )

    def run(
        self, work: Callable[[Task], Answer], tasks: Iterable[Task]
    ) -> Iterator[tuple[Task, Answer | Failure]]:
        """Yield every task with its result, in order of completion.

        Args:
            work: the function.
            tasks: points of a study, or groups of gearboxes.
        """
        from distributed import as_completed

        waiting = iter(tasks)
        running = as_completed()
        submitted: dict[Any, Task] = {}

        def ask(count: int) -> None:
            for point in islice(waiting, count):
                future = self._client.submit(work, point, pure=False)
                submitted[future.key] = point
                running.add(future)

        ask(AHEAD * self._threads())
        for future in running:
            yield submitted.pop(future.key), _result_of(future)
            future.release()
            ask(max(AHEAD * self._threads() - len(submitted), 1))

    def close(self) -> None:
        """Disconnect; the cluster keeps running."""
        self._client.close()

    def _threads(self) -> int:
        return max(sum(self._client.nthreads().values()), 1)


def core_digest() -> str:
    """Digest of the installed core, marked where its level has no fused products: other bits."""
    from .._core import FUSES, SOURCES

    return SOURCES if FUSES else f"{SOURCES} without fused products"


def _result_of(future: Any) -> Any:
    """Result of a point; a point that killed several workers is a failure."""
    from distributed.scheduler import KilledWorker

    try:
        return future.result()
    except KilledWorker as reason:
        return Failure(f"the workers it ran on died: {reason}")
