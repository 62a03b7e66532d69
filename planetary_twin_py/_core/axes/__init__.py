"""The compiled core for axes that move: names as in `_core`, records of its own.

A module of its own, because most scenes do without it and a clone compiles it last.
"""

from importlib import import_module

from .. import LEVEL

_built = import_module(f"{__name__}.{LEVEL}")
globals().update({name: thing for name, thing in vars(_built).items() if name[0] != "_"})
