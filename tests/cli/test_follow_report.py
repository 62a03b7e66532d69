"""Lines that `planetary-twin follow` prints at its end."""

import io

import pytest

from planetary_twin_py.cli._follow_report import print_state
from planetary_twin_py.following.estimate import estimated
from planetary_twin_py.following.state import Following
from planetary_twin_py.following.teeth.changed import ToothState
from planetary_twin_py.terminal.tables import TableConsole


def printed(*teeth):
    state = Following(1.0, (), teeth, (), {}, (), (1.0, 343.15), None, 1.0, (), ())
    text = io.StringIO()
    print_state(TableConsole(file=text, width=200), "paper", (0.0, 1.0), state)
    return text.getvalue()


@pytest.mark.parametrize("others", [(), ("sun tooth 8", "sun tooth 9")])
def test_the_line_of_a_tooth_names_the_teeth_that_are_as_likely(others):
    loss = estimated("stiffness_loss", 0.05, 0.01, "")
    tooth = ToothState("sun", 7, loss, 6.0, ("crack",), ("sun tooth 7", *others))
    (line,) = (line for line in printed(tooth).splitlines() if line.startswith("sun tooth 7"))
    assert line.endswith("; as likely: sun tooth 8, sun tooth 9" if others else "z = 6.0")
