"""Commands are executed in order; changes between two intervals are merged."""

from collections.abc import Mapping

import pytest
from planetary_twin.base.command_queue import CommandQueue


class Twin:
    """Keeps the executed commands; each takes a second."""

    def __init__(self) -> None:
        self.executed: list[object] = []

    def change(self, values: Mapping[str, float]) -> float:
        if values.get("backlash", 0.0) < 0.0:
            raise ValueError("backlash < 0")
        self.executed.append(dict(values))
        return float(len(self.executed))

    def pause(self) -> float:
        self.executed.append("pause")
        return float(len(self.executed))


def execute(commands: CommandQueue) -> None:
    """Execute the queued commands and set their futures."""
    for answer in commands.execute(0.0):
        answer()


def test_changes_between_two_intervals_are_merged():
    twin = Twin()
    commands = CommandQueue(twin.change)
    futures = [commands.change({"backlash": float(n), f"other_{n}": 1.0}) for n in range(3)]
    execute(commands)
    assert twin.executed == [{"backlash": 2.0, "other_0": 1.0, "other_1": 1.0, "other_2": 1.0}]
    assert {future.result(0) for future in futures} == {1.0}
    later = commands.change({"backlash": 7.0})
    execute(commands)
    assert twin.executed[1:] == [{"backlash": 7.0}] and later.result(0) == 2.0


def test_a_refusal_reaches_the_caller_and_a_defect_the_twin_too():
    twin = Twin()
    commands = CommandQueue(twin.change)
    refused = commands.change({"backlash": -1.0})
    execute(commands)
    with pytest.raises(ValueError, match="backlash < 0"):
        refused.result(0)

    def defect() -> float:
        raise ArithmeticError("no solution")

    broken, left = commands.put(defect), commands.put(twin.pause)
    with pytest.raises(ArithmeticError):
        execute(commands)
    commands.refuse("stopped")
    with pytest.raises(ValueError, match="no solution"):
        broken.result(0)
    with pytest.raises(ValueError, match="stopped"):
        left.result(0)
