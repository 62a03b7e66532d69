"""The gallery shows ten machines, each with a small picture that a command of the page makes."""

import re

from docs.blocks import ROOT, blocks

PAGE = ROOT / "docs/gallery.md"
LARGEST = 60_000  # [bytes] largest picture


def shown():
    return re.findall(r"!\[[^]]+\]\((gallery/\w+\.png)\)", PAGE.read_text())


def test_each_of_ten_machines_has_one_picture():
    sections = PAGE.read_text().split("\n## ")[1:]
    assert len(sections) == len(shown()) == len(set(shown())) == 10
    assert all(section.count("![") == 1 for section in sections)


def test_every_picture_is_made_by_a_command_of_the_page():
    commands = [command for block in blocks(PAGE) for command in block.commands]
    made = {word for command in commands for word in command.split() if word.endswith(".png")}
    assert made == {picture.removeprefix("gallery/") for picture in shown()}


def test_every_picture_exists_and_is_small_and_there_is_no_other():
    files = {f"gallery/{file.name}": file.stat().st_size for file in PAGE.parent.glob("gallery/*")}
    assert set(files) == set(shown())
    assert max(files.values()) < LARGEST
