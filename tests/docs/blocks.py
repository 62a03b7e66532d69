"""The fenced blocks of a page of the documentation, and how each is tested.

The first word of an info string is the language, the others say how a block is tested:
`file=NAME` writes it there, `background` starts its commands and ends them after the page,
`not-run=REASON` skips it, for one of `REASONS`.
"""

import re
import shlex
from dataclasses import dataclass
from pathlib import Path

from markdown_it import MarkdownIt

ROOT = Path(__file__).parents[2]
LANGUAGES = {"python", "c++", "console", "yaml", "diff", "text"}
REASONS = {
    "ros2": "needs the command ros2, which is not to be had from a package index",
    "desktop": "needs a program with windows: RViz, PlotJuggler, Foxglove, Rerun, a browser",
    "set-up": "sets up, builds or tests the project itself, which tests/setup and CI do",
    "cluster": "needs machines of a cluster",
    "minutes": "takes minutes",
    "cosimulation": "needs FMPy or MuJoCo; make test-cosimulation runs the same",
}


@dataclass(frozen=True)
class Block:
    """A fenced block: its position, its language and its text."""

    page: Path
    line: int
    language: str
    words: tuple[str, ...]
    text: str

    def __str__(self) -> str:
        return f"{self.page.relative_to(ROOT)}:{self.line}"

    def word(self, name: str) -> str | None:
        """The value of `name=...` in the info string."""
        values = dict(word.split("=", 1) for word in self.words if "=" in word)
        return values.get(name)

    @property
    def commands(self) -> list[str]:
        """Lines after a prompt with their continuation lines; the others are output."""
        return [command for command, _ in self.session]

    @property
    def session(self) -> list[tuple[str, str]]:
        """Each command, and the output that follows it; empty if none is shown."""
        found: list[tuple[str, str]] = []
        for line in self.text.replace("\\\n", " ").splitlines():
            if line.startswith("$ "):
                found.append((line[2:], ""))
            elif found:
                command, output = found[-1]
                found[-1] = command, f"{output}{line}\n"
        return found


def shows(output: str, printed: str) -> bool:
    """Whether `output` is an excerpt of what is printed.

    `...` stands for anything, also over several lines. Lines before the first one and after the
    last one may be left out, and white space is that of any width of the page.
    """
    parts = (re.escape(" ".join(part.split())) for part in output.split("..."))
    return re.search(".*".join(parts), " ".join(printed.split())) is not None


def pages() -> list[Path]:
    """Every page that is written by hand."""
    folder = ROOT / "docs"
    parts = (folder, folder / "howto")
    return [ROOT / "README.md", *(page for part in parts for page in sorted(part.glob("*.md")))]


def blocks(page: Path) -> list[Block]:
    """The fenced blocks of a page, in order, without the directives of the site."""
    tokens = MarkdownIt().parse(page.read_text())
    return [
        Block(page, token.map[0] + 1, *_said(token.info), token.content)
        for token in tokens
        if token.type == "fence" and not token.info.startswith("{")
    ]


def _said(info: str) -> tuple[str, tuple[str, ...]]:
    language, *words = shlex.split(info) or [""]
    return language, tuple(words)
