"""Writes the pages of the reference: `python -m _generate` in docs/."""

from pathlib import Path

from . import PAGES

for name, page in PAGES.items():
    (Path(__file__).parents[1] / "reference" / name).write_text(page())
