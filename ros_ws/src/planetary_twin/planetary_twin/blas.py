"""Threads of NumPy's linear algebra in the process of a node."""

from collections.abc import MutableMapping


def use_one_thread(environment: MutableMapping[str, str]) -> None:
    """
    Set the number of threads in the environment of a process that has not loaded NumPy.

    The matrices of a node are small: more threads would use a second core for waiting only (a
    follower with vibration at 20 kHz takes 25 % of a core instead of 11 %). A value set by the
    user is kept.
    """
    environment.setdefault("OPENBLAS_NUM_THREADS", "1")
