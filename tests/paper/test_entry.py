"""A verdict follows from the claims, whichever form reaches them."""

import pytest
from planetary_twin_paper.entry import Claim, Entry, Verdict


def claim(kind, holds, printed_holds=False, why=""):
    return Claim(
        says="", ours="", holds=holds, printed="", printed_holds=printed_holds, kind=kind, why=why
    )


def entry(*claims):
    return Entry(number="Figure 1", title="", claims=claims)


CASES = [
    ((("number", True),), Verdict.REPRODUCED),
    ((("trend", True),), Verdict.TREND),
    ((("number", True), ("trend", True)), Verdict.REPRODUCED),
    ((("number", False), ("trend", True)), Verdict.TREND),
    ((("number", True), ("trend", False)), Verdict.CANNOT),
    ((("number", False),), Verdict.CANNOT),
    ((("number", True), ("number", False)), Verdict.CANNOT),
]


@pytest.mark.parametrize("claims, verdict", CASES)
def test_verdict(claims, verdict):
    assert entry(*(claim(*c) for c in claims)).verdict is verdict


def test_what_only_the_printed_form_reaches_is_explained():
    found = entry(claim("number", False, True, "ours differs"))
    assert found.verdict is Verdict.REPRODUCED
    only = "one statement is reached in the printed form only, because ours differs"
    assert found.reason == only


def test_reasons_are_given_once_where_something_is_missed():
    found = entry(
        claim("number", False, why="a"), claim("number", False, why="a"), claim("trend", 1)
    )
    assert found.reason == "a"
    assert entry(claim("trend", True, why="unused")).reason == ""
