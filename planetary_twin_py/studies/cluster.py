"""Execution by a Dask cluster, whose workers may join, leave or fail during the study."""

from __future__ import annotations

from concurrent.futures import Executor
from typing import Any

from ..simulation.threads import Pool
from .work import Failure

_TIMEOUT = 30.0  # [s] for the scheduler to answer, and for its first worker


class Cluster(Pool):
    """The workers of a Dask scheduler.

    If a worker dies, another worker repeats its point; a point that kills several workers fails.
    All workers must have this version of the package, so that their results are identical.

    Args:
        address: address of the scheduler, e.g. "tcp://10.0.0.1:8786".

    Raises:
        ValueError: there is no scheduler, it has no workers, or a worker has another core.
    """

    ahead = 4
    """More than threads need: a task takes a way through the network."""

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

    def close(self) -> None:
        """Disconnect; the cluster keeps running."""
        self._client.close()

    def _open(self) -> Executor:
        return self._client.get_executor(pure=False)

    def _workers(self) -> int:
        return max(sum(self._client.nthreads().values()), 1)

    def _answer(self, done: Any) -> Any:
        """Result of a point; a point that killed several workers is a failure."""
        from distributed.scheduler import KilledWorker

        try:
            return done.result()
        except KilledWorker as reason:
            return Failure(f"the workers it ran on died: {reason}")

    def _close(self, pool: Any, unfinished: Any) -> None:
        pool.shutdown(wait=False)  # and cancels what is unfinished


def core_digest() -> str:
    """Digest of the installed core, marked where its level has no fused products: other bits."""
    from .._core import FUSES, SOURCES

    return SOURCES if FUSES else f"{SOURCES} without fused products"
