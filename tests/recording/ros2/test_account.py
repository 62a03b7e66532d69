"""Losses follow from the sequence numbers of the publishers."""

import pytest

from planetary_twin_py.recording.ros2.account import TopicAccount

TWO = {"publishers": 2}


@pytest.mark.parametrize(
    ("numbers", "how", "before", "missed"),
    [
        pytest.param([1, 2, 3], {}, 0, 0, id="an unbroken sequence loses nothing"),
        pytest.param([3, 4, 7, 10], {}, 2, 4, id="recorded and lost add up to published"),
        pytest.param([1, 1, 2, 2, 3, 4, 3, 4], TWO, 0, 0, id="publishers count separately"),
        pytest.param([1, 50, 2, 51], TWO, 49, 0, id="a second publisher received late"),
        pytest.param([1, 2, 3, 1, 2], {}, 0, 0, id="a restart begins a new sequence"),
    ],
)
def test_losses_are_the_numbers_that_were_skipped(numbers, how, before, missed) -> None:
    account = _account(numbers, **how)
    assert account.recorded == len(numbers)
    assert (account.before, account.missed, account.lost) == (before, missed, before + missed)


@pytest.mark.parametrize(("numbers", "lost"), [([7, 8], 0), ([7, 9], 1)])
def test_only_a_gap_on_a_latched_topic_is_a_loss(numbers: list[int], lost: int) -> None:
    assert _account(numbers, latched=True).lost == lost


def _account(numbers: list[int], publishers: int = 1, latched: bool = False) -> TopicAccount:
    account = TopicAccount(latched=latched)
    for number in numbers:
        account.receive(number, lambda: publishers)
    return account
