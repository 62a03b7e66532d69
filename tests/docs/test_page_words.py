"""Words outside the vocabulary of the field do not occur on pages and in interface files."""

import re

import pytest
from docs.blocks import ROOT, pages

DIALECT = re.compile(
    r"\b(told|tells|untold|anew|alike|begun|thrown|whereof|thereof|heard|whoever)\b", re.IGNORECASE
)
INTERFACES = sorted([*ROOT.glob("msgs_spec/msg/*.msg"), *ROOT.glob("msgs_spec/srv/*.srv")])
READMES = [
    ROOT / name
    for name in (
        "CONTRIBUTING.md", "CHANGELOG.md", "msgs_spec/README.md", "benchmarks/README.md",
        "recordings/README.md", "ros_ws/src/planetary_twin/README.md",
    )
]  # fmt: skip


@pytest.mark.parametrize(
    "page", [*pages(), *READMES, *INTERFACES], ids=lambda page: str(page.relative_to(ROOT))
)
def test_a_page_has_plain_words_only(page):
    text = re.sub(r"`[^`\n]+`", "", page.read_text())  # names of files may contain anything
    assert DIALECT.findall(text) == []


def test_the_search_finds_words_between_marks():
    assert DIALECT.findall("what is *told*, anew") == ["told", "anew"]
