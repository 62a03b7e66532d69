"""Every equation, table and figure has its place, and every place that is named exists."""

import re
from operator import attrgetter
from pathlib import Path

import pytest
import yaml
from planetary_twin_paper.equations import EQUATIONS

import planetary_twin_py as pt

ROOT = Path(__file__).parents[2]
PACKAGE = Path(pt.__file__).parent
PAGE = (ROOT / "docs" / "paper.md").read_text("utf-8")
CHOICES = [(equation, equation.choice) for equation in EQUATIONS if equation.choice]


def test_every_equation_appears():
    named = [number for equation in EQUATIONS for number in equation.numbers]
    assert len(set(named)) == len(named)
    plain = {int(re.match(r"\d+", number)[0]) for number in named}
    assert plain == set(range(1, 39))
    assert {"1a", "1b", "1c", "1d", "1e"} <= set(named)
    # The paper uses three numbers twice.
    assert all(n in named and f"{n}, section 9" in named for n in ("20", "21", "22"))


@pytest.mark.parametrize("equation", EQUATIONS, ids=lambda e: e.label)
def test_files_named_exist(equation):
    named = [
        equation.file,
        *re.findall(r"`([\w/]+\.[ch]?p[py])`", equation.default + equation.printed),
    ]
    assert all((PACKAGE / name).is_file() for name in named)


@pytest.mark.parametrize("equation, choice", CHOICES, ids=lambda x: getattr(x, "label", None))
def test_choices_named_are_fields_and_on_in_paper_printed(equation, choice):
    ((name, value),) = yaml.safe_load(choice).items()
    chosen = pt.load_scene("paper").replace(**{name: value})
    field = attrgetter(name)
    assert field(chosen) == field(pt.load_scene("paper_printed"))


def test_page_has_every_table_and_figure_with_a_verdict():
    for number in [*(f"Table {n}" for n in range(1, 6)), *(f"Figure {n}" for n in range(1, 15))]:
        assert re.search(rf"^### {number}: ", PAGE, re.MULTILINE), number
        row = re.search(rf"^\| \[{number}\]\(#[\w-]+\): \*\*(.+?)\*\* \| \w", PAGE, re.MULTILINE)
        assert row[1] in ("reproduced", "trend reproduced", "cannot be reproduced")


def test_every_figure_of_the_page_is_there_and_small():
    pictures = re.findall(r"!\[(Figure \d+):[^]]*\]\((.+?)\)", PAGE)
    assert [number for number, _ in pictures] == [f"Figure {n}" for n in range(1, 15)]
    for _, file in pictures:
        assert 0 < (ROOT / "docs" / file).stat().st_size < 60_000
