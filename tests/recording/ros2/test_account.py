"""Losses follow from the sequence numbers of the publishers."""

import pytest

from planetary_twin_py.recording.ros2.account import TopicAccount, recorded_losses


def _account(numbers: list[int], publishers: int = 1, latched: bool = False) -> TopicAccount:
    account = TopicAccount(latched=latched)
    for number in numbers:
        account.receive(number, lambda: publishers)
    return account


def test_an_unbroken_sequence_loses_nothing() -> None:
    account = _account([1, 2, 3])
    assert (account.recorded, account.lost) == (3, 0)


def test_recorded_and_lost_add_up_to_published() -> None:
    account = _account([3, 4, 7, 10])
    assert (account.before, account.missed) == (2, 4)
    assert account.recorded + account.lost == 10


def test_a_late_subscriber_to_a_latched_topic_has_lost_nothing() -> None:
    account = _account([7, 8], latched=True)
    assert account.lost == 0


def test_a_gap_on_a_latched_topic_is_a_loss() -> None:
    assert _account([7, 9], latched=True).lost == 1


def test_two_publishers_are_counted_separately() -> None:
    account = _account([1, 1, 2, 2, 3, 4, 3, 4], publishers=2)
    assert account.lost == 0


def test_a_second_publisher_received_late_is_no_gap() -> None:
    account = _account([1, 50, 2, 51], publishers=2)
    assert (account.before, account.missed) == (49, 0)


def test_a_restarted_publisher_starts_a_new_sequence() -> None:
    assert _account([1, 2, 3, 1, 2]).lost == 0


def test_recorded_losses_are_those_of_the_account() -> None:
    account = {"topic": "/t", "lost": "3", "missed": "2", "recorded": "7", "other": "x"}
    assert recorded_losses(account) == ("/t", 3, 2, 7)


@pytest.mark.parametrize(
    ("changes", "reason"),
    [
        ({"lost": "inf"}, r"^lost = 'inf': must be a whole number$"),
        ({"missed": "1_0"}, r"^missed = '1_0': must be a whole number$"),
        ({"missed": "9" * 5000}, r"^missed = '9{27} \.\.\. 9{27}': must be a whole number$"),
    ],
)
def test_a_recorded_loss_that_is_no_number_is_refused(changes: dict[str, str], reason: str) -> None:
    with pytest.raises(ValueError, match=reason):
        recorded_losses({"topic": "/t", "lost": "0", "missed": "0", "recorded": "1"} | changes)
    with pytest.raises(ValueError, match=r"^topic: missing$"):
        recorded_losses({"lost": "0", "missed": "0", "recorded": "1"})
