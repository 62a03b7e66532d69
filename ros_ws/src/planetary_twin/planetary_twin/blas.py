"""Threads of NumPy's linear algebra in the process of a node."""

from collections.abc import MutableMapping


def use_one_thread(environment: MutableMapping[str, str]) -> None:
    """
    Set the number of threads in the environment of a process that has not loaded NumPy.

    The matrices of a node are small: more threads would keep a second core busy with waiting (a
    follower of vibration at 20 kHz: 25 % instead of 11 % of a core). What a user has set stays.
    """
    environment.setdefault("OPENBLAS_NUM_THREADS", "1")
