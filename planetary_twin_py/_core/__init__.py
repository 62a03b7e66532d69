"""The compiled core: records and functions of `planetary_twin_py/core`, as C++ has them.

It is built once for each processor level; the best that this machine runs is loaded. What it holds
is in the stub beside, which is made when it is built.
"""

from importlib import import_module
from importlib.util import find_spec
from types import ModuleType

from .levels import runnable_levels


def _load() -> ModuleType:
    for level in runnable_levels():
        if find_spec(f"{__name__}.{level}"):
            return import_module(f"{__name__}.{level}")
    wanted = " or ".join(runnable_levels())
    raise ImportError(f"the compiled core is not built for {wanted}: make setup, or pip install .")


_built = _load()
globals().update({name: thing for name, thing in vars(_built).items() if name[0] != "_"})
LEVEL = _built.__spec__.name.rpartition(".")[2]
