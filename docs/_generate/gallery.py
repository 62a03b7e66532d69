"""Renews the pictures of the gallery: `python -m _generate.gallery` in docs/.

The page is the source: its commands are run in a temporary folder.
"""

import shutil
import subprocess
from pathlib import Path
from tempfile import TemporaryDirectory

from markdown_it import MarkdownIt
from PIL import Image

DOCS = Path(__file__).parents[1]
PAGE = DOCS / "gallery.md"
PICTURES = DOCS / "gallery"
COLOURS = 64  # a diagram has few colours; with a palette its file is a third as large


def main() -> None:
    """Run the page, then write every picture that its commands made."""
    with TemporaryDirectory() as name:
        folder = Path(name)
        for part in ("tests/data", "docs/examples"):
            shutil.copytree(DOCS.parent / part, folder / part)
        for fence in MarkdownIt().parse(PAGE.read_text()):
            if fence.type == "fence":
                _run(fence.content, folder)
        PICTURES.mkdir(exist_ok=True)
        for picture in sorted(folder.glob("*.png")):
            with Image.open(picture) as image:
                image.convert("RGB").quantize(COLOURS).save(PICTURES / picture.name, optimize=True)


def _run(text: str, folder: Path) -> None:
    """Run the commands that a block holds."""
    for line in text.splitlines():
        if line.startswith("$ "):
            print(line, flush=True)
            subprocess.run(line[2:], shell=True, cwd=folder, check=True)


if __name__ == "__main__":
    main()
