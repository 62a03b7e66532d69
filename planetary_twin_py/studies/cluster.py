"""Points on the workers of a Dask cluster, which may come, go and die while it runs."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from itertools import islice
from typing import Any

from .._compile import cache_folder
from .plan import Point
from .work import Failure, Found

AHEAD = 4  # points for each thread of the cluster that are under way or wait for their turn
_PATIENCE = 30.0  # [s] for a scheduler to answer, and for its first worker


class Cluster:
    """The workers of the scheduler at `address`, e.g. "tcp://10.0.0.1:8786".

    A point whose worker dies is run again by another; one that takes several workers with it
    fails. All workers must have this version of the package, so that all compute the same.

    Raises:
        ValueError: there is no scheduler, it has no worker, or one of other kernels.
    """

    def __init__(self, address: str) -> None:
        from distributed import Client

        try:
            self._client = Client(address, timeout=_PATIENCE)
            self._client.wait_for_workers(1, timeout=_PATIENCE)
        except (OSError, TimeoutError, ValueError) as reason:
            raise ValueError(f"scheduler = {address!r}: {reason}") from None
        here = kernels()
        for worker, there in self._client.run(kernels).items():
            if there != here:
                raise ValueError(
                    f"scheduler = {address!r}: worker {worker} has kernels {there}, here {here}; "
                    "install the same version"
                )

    def do(
        self, work: Callable[[Point], Found], points: Iterable[Point]
    ) -> Iterator[tuple[Point, Found]]:
        """Every point with what was found there, as they are done."""
        from distributed import as_completed

        waiting = iter(points)
        under_way = as_completed()
        asked: dict[Any, Point] = {}

        def ask(count: int) -> None:
            for point in islice(waiting, count):
                future = self._client.submit(work, point, pure=False)
                asked[future.key] = point
                under_way.add(future)

        ask(AHEAD * self._threads())
        for future in under_way:
            yield asked.pop(future.key), _found(future)
            future.release()
            ask(max(AHEAD * self._threads() - len(asked), 1))

    def close(self) -> None:
        """Leave the cluster as it is."""
        self._client.close()

    def _threads(self) -> int:
        return max(sum(self._client.nthreads().values()), 1)


def kernels() -> str:
    """Digest of the kernels that compute here."""
    return cache_folder().name


def _found(future: Any) -> Found:
    """What a point gave; a worker killed by it several times over is its failure, not ours."""
    from distributed.scheduler import KilledWorker

    try:
        return future.result()
    except KilledWorker as reason:
        return Failure(f"the workers it ran on died: {reason}")
