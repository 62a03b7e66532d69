"""Write the digest of the core's sources as C++: digest.py SOURCES OUT.

Everything that decides about bits counts: the sources, and the compiler's options beside them.
"""

import hashlib
import sys
from pathlib import Path

LENGTH = 16  # hexadecimal digits


def digest(folder: Path) -> str:
    """Digest of names and contents, whatever the order in which files are found."""
    found = hashlib.sha256()
    kept = ("*.hpp", "*.cpp", "CMakeLists.txt")
    for path in sorted(file for kind in kept for file in folder.rglob(kind)):
        found.update(path.relative_to(folder).as_posix().encode() + b"\0" + path.read_bytes())
    return found.hexdigest()[:LENGTH]


def main(folder: Path, out: Path) -> None:
    """Write `gearbox::SOURCES`."""
    text = f'extern const char* const SOURCES;\nconst char* const SOURCES = "{digest(folder)}";\n'
    out.write_text(f"namespace gearbox {{\n{text}}}  // namespace gearbox\n")


if __name__ == "__main__":
    main(Path(sys.argv[1]), Path(sys.argv[2]))
