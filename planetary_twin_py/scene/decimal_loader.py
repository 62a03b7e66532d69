"""Loader of YAML that reads decimal numbers only.

YAML 1.1 reads 010 as 8, 1:30 as 90, 0x10 as 16 and 1_0 as 10. Here these are text, which the field
of a scene refuses, or, of leading zeros, reads as decimal.
"""

from __future__ import annotations

import math
import re
from typing import Any

import yaml

_INT, _FLOAT = "tag:yaml.org,2002:int", "tag:yaml.org,2002:float"
# Each is a part of what YAML 1.1 reads as such a number, so that text which PyYAML writes without
# quotes remains text.
_WHOLE = re.compile(r"[-+]?(?:0|[1-9][0-9]*)")
_DECIMAL = re.compile(
    r"[-+]?[0-9]+\.[0-9]*(?:[eE][-+][0-9]+)?|\.[0-9]+(?:[eE][-+][0-9]+)?"
    r"|[-+]?\.(?:inf|Inf|INF)|\.(?:nan|NaN|NAN)"
)
_MOST_DIGITS = 300  # of a whole number that is not text; a float holds each of them


def _loader() -> Any:
    """The class of the loader."""
    # That of libyaml, which every wheel of PyYAML holds, is ten times as fast.
    base: Any = getattr(yaml, "CSafeLoader", yaml.SafeLoader)
    others = {
        first: [(tag, form) for tag, form in resolvers if tag not in (_INT, _FLOAT)]
        for first, resolvers in base.yaml_implicit_resolvers.items()
    }
    loader: Any = type("DecimalLoader", (base,), {"yaml_implicit_resolvers": others})
    loader.add_implicit_resolver(_INT, re.compile(f"(?:{_WHOLE.pattern})$"), "-+0123456789")
    loader.add_implicit_resolver(_FLOAT, re.compile(f"(?:{_DECIMAL.pattern})$"), "-+0123456789.")
    loader.add_constructor(_INT, _whole)
    loader.add_constructor(_FLOAT, _decimal)
    return loader


def _whole(loader: Any, node: Any) -> int | str:
    """A whole number; text if it has more digits than any field allows."""
    text = str(loader.construct_scalar(node))
    if not _WHOLE.fullmatch(text):
        raise ValueError(f"{text!r} is not a whole number in decimal digits")
    return int(text) if len(text) <= _MOST_DIGITS else text


def _decimal(loader: Any, node: Any) -> float:
    text = str(loader.construct_scalar(node))
    if not (_DECIMAL.fullmatch(text) or _WHOLE.fullmatch(text)):
        raise ValueError(f"{text!r} is not a decimal number")
    value = text.lower().lstrip("+-")
    if value in (".inf", ".nan"):
        size = math.inf if value == ".inf" else math.nan
        return -size if text.startswith("-") else size
    return float(text)


DecimalLoader: Any = _loader()
"""As `yaml.SafeLoader`, but for numbers."""
