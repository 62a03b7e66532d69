"""How the numerical kernels are compiled.

numba keeps compiled code per file, and does not notice when a function a kernel calls from
another file has changed. The cache folder is therefore named after the source of all kernels.
"""

from __future__ import annotations

import hashlib
import os
from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeVar, cast

import numba

from ._program import Kernel

F = TypeVar("F", bound=Callable[..., Any])

# Reassociation and fused multiplies change the last bits only; NaN and infinity stay visible.
_FAST = {"reassoc", "nsz", "arcp", "contract"}


# Where kernels are, and what they take constants from.
_KERNELS = (
    "_*.py",
    "benchmark/peers/equations.py",
    "dynamics/*.py",
    "integrators/*.py",
    "losses/*.py",
    "lubrication/*.py",
    "mesh/*.py",
    "quasi_static/*.py",
)


def _source_hash() -> str:
    digest = hashlib.sha256(numba.__version__.encode())
    home = Path(__file__).parent
    for path in sorted(p for place in _KERNELS for p in home.glob(place)):
        digest.update(path.read_bytes())
    return digest.hexdigest()[:16]


def cache_folder() -> Path:
    """Where compiled kernels are kept."""
    base = os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache"
    return Path(base) / "planetary_twin" / _source_hash()


if "NUMBA_CACHE_DIR" not in os.environ:
    numba.config.CACHE_DIR = str(cache_folder())  # type: ignore[attr-defined]


def kernel(function: F) -> F:
    """Compile on first use, keep the machine code, release the interpreter lock."""
    return _compiled(function)


def law(function: F) -> F:
    """The same for a formula, which is merged into its caller so that loops over it vectorise."""
    return _compiled(function, forceinline=True)


def allocating(function: F) -> F:
    """The same for a kernel that makes arrays of its own, which others do without.

    Whoever makes none need not count who holds them: less to compile, and less to run.
    """
    return _compiled(function, _nrt=True)


def _compiled(function: F, **special: bool) -> F:
    options = {
        "nopython": True,
        "nogil": True,
        "error_model": "numpy",
        "fastmath": _FAST,
        "_nrt": False,
    }
    return cast(F, Kernel(function, options | special))
