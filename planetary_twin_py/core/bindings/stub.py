"""Make the type stub of the built core: stub.py FOLDER, in which planetary_twin_py/_core is built.

It is nanobind's, but that the fields of a record are named where it is made, so that a type checker
finds one that is misspelt there too, and that an array takes whatever NumPy makes an array of.
"""

import importlib
import re
import sys
from pathlib import Path
from types import ModuleType

from nanobind import stubgen

ANYTHING = "def __init__(self, **kwargs) -> None: ..."
ARRAY_SETTER = re.compile(r"(def \w+\(self, arg: )object(, /\) -> None)")
SETTER = re.compile(r"\.setter\n +def (\w+)\(self, arg: (.+), /\)")
LISTING = re.compile(r"^([A-Z_]+): (?:dict|tuple) = .*$", re.MULTILINE)  # of laws, for example
CLASS = re.compile(r"^class \w+.*:\n(?:(?: .*)?\n)+", re.MULTILINE)


def with_fields(record: re.Match[str]) -> str:
    """Name the fields of a record in its constructor."""
    fields = "".join(f", {name}: {kind} = ..." for name, kind in SETTER.findall(record[0]))
    if not fields:
        return record[0]
    return record[0].replace(ANYTHING, f"def __init__(self, *{fields}) -> None: ...")


def kind_of(value: object) -> str:
    """Type of a listing, whose entries have one type."""
    if isinstance(value, dict):
        return f"dict[str, {kind_of(next(iter(value.values())))}]"
    return f"tuple[{kind_of(value[0])}, ...]" if isinstance(value, tuple) else type(value).__name__


def main(folder: Path) -> None:
    """Write the stub beside what it describes."""
    # That of the sources would come first, without a core.
    package = ModuleType("planetary_twin_py")
    package.__path__ = [str(folder / "planetary_twin_py")]
    sys.modules["planetary_twin_py"] = package
    out = folder / "planetary_twin_py/_core/__init__.pyi"
    stubgen.main(["-q", "-m", "planetary_twin_py._core", "-o", str(out)])
    text = ARRAY_SETTER.sub(r"\1numpy.typing.ArrayLike\2", out.read_text())
    text = text.replace("import numpy\n", "import numpy\nimport numpy.typing\n", 1)
    core = importlib.import_module("planetary_twin_py._core")
    text = LISTING.sub(lambda found: f"{found[1]}: {kind_of(getattr(core, found[1]))} = ...", text)
    out.write_text(CLASS.sub(with_fields, text))
    # Its classes have the fields of those for axes that are held.
    axes = out.parent / "axes"
    axes.mkdir(exist_ok=True)
    (axes / out.name).write_text("from planetary_twin_py._core import *\n")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
