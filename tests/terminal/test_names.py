"""Names in lines and tables are one line without control characters and markup."""

import pytest
from command_line import succeed
from rich.text import Text

from planetary_twin_py.terminal.names import shown


@pytest.mark.parametrize(
    ("name", "line"),
    [
        ("/planetary_twin/gearbox_state", "/planetary_twin/gearbox_state"),
        ("a\nplanetary-twin: fake\r\tb", "a\\nplanetary-twin: fake\\r b"),
        ("\x1b[31mred", "\\x1b[31mred"),
        ("[bold]x[/y]", "[bold]x[/y]"),
        ("", ""),
    ],
)
def test_a_name_is_shown_as_one_plain_line(name, line):
    assert Text.from_markup(shown(name)).plain == line


def test_a_line_end_or_markup_in_the_name_of_a_scene_is_escaped(tmp_path):
    file = tmp_path / "scene.yaml"
    file.write_text('base: paper\nname: "a\\nplanetary-twin: fake [/x]"\n', "utf-8")
    answer = succeed("modal", file)
    assert "a\\nplanetary-twin: fake [/x], " in " ".join(answer.output.split())
