"""Words outside the vocabulary of the field do not occur in messages, docstrings and names."""

import io
import re
import tokenize
from pathlib import Path

ROOT = Path(__file__).parents[2]
PACKAGE = ROOT / "planetary_twin_py"
NODES = ROOT / "ros_ws/src/planetary_twin"
DIALECT = re.compile(
    r"\b(told|untold|anew|alike|begun|thrown|whereof|thereof|heard|torn|whoever|lest)\b",
    re.IGNORECASE,
)
DEPRECATED = {
    (f"planetary_twin_py/cli/{file}.py", word)
    for file, word in (("_fit_points", "told"), ("_fit_points", "untold"), ("doctor", "told"))
} | {
    ("tests/cli/test_fit_command.py", "told"),
    ("tests/cli/test_fit_command.py", "untold"),
    ("tests/doctor/test_doctor.py", "told"),
}
"""JSON keys that are kept beside their plain names."""
THIS = Path(__file__)
FILES = sorted(
    file
    for folder in (
        PACKAGE,
        NODES,
        ROOT / "benchmarks",
        ROOT / "tools",
        ROOT / "tests",
        ROOT / "docs",
    )
    for file in folder.rglob("*.py")
    if not {"build", "core"} & {*file.relative_to(folder).parts} or folder.name == "tests"
    if file not in (THIS, THIS.with_name("test_page_words.py"))
)
CORE = sorted(file for file in (PACKAGE / "core").rglob("*") if file.suffix in {".hpp", ".cpp"})


def found_in(source):
    """Words of the dialect in the comments, strings and names of a Python source."""
    if not DIALECT.search(source.replace("_", " ")):
        return set()
    tokens = tokenize.generate_tokens(io.StringIO(source).readline)
    kinds = {tokenize.COMMENT, tokenize.STRING, tokenize.NAME}
    kinds.add(getattr(tokenize, "FSTRING_MIDDLE", tokenize.STRING))  # from Python 3.12
    texts = (token.string.replace("_", " ") for token in tokens if token.type in kinds)
    return {word.lower() for text in texts for word in DIALECT.findall(text)}


def test_sources_have_plain_words_only():
    found = {
        (path, word)
        for file in FILES
        for path in [str(file.relative_to(ROOT))]
        for word in found_in(file.read_text(encoding="utf-8"))
    }
    assert found - DEPRECATED == set()


def test_sources_of_the_core_have_plain_words_only():
    found = {str(file): DIALECT.findall(file.read_text(encoding="utf-8")) for file in CORE}
    assert {file: words for file, words in found.items() if words} == {}


def test_comments_strings_and_names_are_searched():
    assert found_in('x = "not told"\n') == {"told"}
    assert found_in("x = 1  # begun\n") == {"begun"}
    assert found_in("_told_again = f'anew {1}'\n") == {"told", "anew"}
    assert found_in("x = 'is reported'\n") == set()
