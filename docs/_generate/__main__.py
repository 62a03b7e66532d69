"""Writes the pages of the reference: `python -m _generate reference` in docs/."""

import sys
from pathlib import Path

from . import PAGES

for name, page in PAGES.items():
    (Path(sys.argv[1]) / name).write_text(page())
