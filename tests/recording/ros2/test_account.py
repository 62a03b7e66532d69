"""Losses follow from the sequence numbers of the publishers."""

from planetary_twin_py.recording.ros2.account import TopicAccount


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
