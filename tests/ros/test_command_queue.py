"""Orders are carried out in turn; changes that would hold from the same instant are one."""

from __future__ import annotations

from collections.abc import Mapping

import pytest
from planetary_twin.orders import Orders


class Twin:
    """Notes what it is told; every change takes a second."""

    def __init__(self) -> None:
        self.told: list[object] = []

    def change(self, values: Mapping[str, float]) -> float:
        if values.get("backlash", 0.0) < 0.0:
            raise ValueError("backlash < 0")
        self.told.append(dict(values))
        return float(len(self.told))

    def pause(self) -> float:
        self.told.append("pause")
        return float(len(self.told))


def carry_out(orders: Orders) -> None:
    """Let orders be carried out and answered."""
    for answer in orders.carry_out(0.0):
        answer()


def test_changes_between_two_intervals_are_one_of_what_was_given_last() -> None:
    twin = Twin()
    orders = Orders(twin.change)
    futures = [orders.change({"backlash": float(n), f"other_{n}": 1.0}) for n in range(3)]
    carry_out(orders)
    assert twin.told == [{"backlash": 2.0, "other_0": 1.0, "other_1": 1.0, "other_2": 1.0}]
    assert {future.result(0) for future in futures} == {1.0}
    later = orders.change({"backlash": 7.0})
    carry_out(orders)
    assert twin.told[1:] == [{"backlash": 7.0}] and later.result(0) == 2.0


def test_no_change_overtakes_another_order() -> None:
    twin = Twin()
    orders = Orders(twin.change)
    orders.change({"backlash": 1.0})
    orders.give(twin.pause)
    orders.change({"backlash": 2.0})
    carry_out(orders)
    assert twin.told == [{"backlash": 1.0}, "pause", {"backlash": 2.0}]


def test_what_is_given_meanwhile_waits_so_that_no_flood_holds_the_twin_up() -> None:
    twin = Twin()
    orders = Orders(twin.change)

    def endless() -> float:
        orders.give(endless)
        return twin.pause()

    orders.give(endless)
    carry_out(orders)
    assert twin.told == ["pause"]


def test_a_refusal_goes_to_who_gave_the_order_and_a_defect_to_the_twin_too() -> None:
    twin = Twin()
    orders = Orders(twin.change)
    refused = orders.change({"backlash": -1.0})
    carry_out(orders)
    with pytest.raises(ValueError, match="backlash < 0"):
        refused.result(0)

    def defect() -> float:
        raise ArithmeticError("no solution")

    broken, left = orders.give(defect), orders.give(twin.pause)
    with pytest.raises(ArithmeticError):
        carry_out(orders)
    orders.refuse("stopped")
    with pytest.raises(ValueError, match="no solution"):
        broken.result(0)
    with pytest.raises(ValueError, match="stopped"):
        left.result(0)
