"""Functions of the compiled core that only tests and benchmarks call: no part of the twin's wheel.

`tools/build_core` compiles the sources in this folder for the processor levels that it builds of
the core. Their docstrings say what they are.
"""

from importlib import import_module
from typing import Any

from planetary_twin_py._core import LEVEL

_built = import_module(f"{__name__}.{LEVEL}")


def __getattr__(name: str) -> Any:
    """Find a function in the module of the level of the core that runs."""
    return getattr(_built, name)
