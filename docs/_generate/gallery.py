"""Renews the pictures of the gallery: `python -m _generate.gallery` in docs/.

The page is the source: its files are written and its commands are run in a temporary folder.
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
        shutil.copytree(DOCS.parent / "tests" / "data", folder / "tests" / "data")
        for fence in MarkdownIt().parse(PAGE.read_text()):
            if fence.type == "fence":
                _run(fence.info, fence.content, folder)
        PICTURES.mkdir(exist_ok=True)
        for picture in sorted(folder.glob("*.png")):
            with Image.open(picture) as image:
                image.convert("RGB").quantize(COLOURS).save(PICTURES / picture.name, optimize=True)


def _run(info: str, text: str, folder: Path) -> None:
    """Write the file that a block names, or run the commands that it holds."""
    if "file=" in info:
        (folder / info.split("file=")[1]).write_text(text)
    for line in text.splitlines():
        if line.startswith("$ "):
            print(line, flush=True)
            subprocess.run(line[2:], shell=True, cwd=folder, check=True)


if __name__ == "__main__":
    main()
