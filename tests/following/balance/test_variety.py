"""Remedies are those that the readings lack."""

import numpy as np
from following.plants import balance_of, paper, played

from planetary_twin_py.following.balance.balances import B, D, F, G, J, Measured
from planetary_twin_py.following.balance.filter import SLOW_FALL
from planetary_twin_py.following.balance.follower import BalanceFollower
from planetary_twin_py.following.balance.variety import (
    LONGER,
    ROTATION_REVERSAL,
    SPEED_CHANGE,
    TORQUE_REVERSAL,
    WITHOUT_LOAD,
    Variety,
)
from planetary_twin_py.following.train import followed_train

UNRELATED = np.eye(7)
NOTHING = np.zeros((3, 1))  # acceleration, its noise, oil temperature


def seen(*points, step=0.1):
    """Readings of torque and speed, over those of the scene."""
    train = followed_train(paper())
    found = Variety(train)
    for number, (torque, speed) in enumerate(points):
        torque, speed = np.array([torque * train.torque]), np.array([speed * train.speed])
        found.add(Measured(step * number, torque, -torque, np.ones((2, 1)), speed, *NOTHING))
    return found


def test_readings_before_step_and_of_many_hours_ago_do_not_count():
    found = seen((1.0, 1.0), (-1.0, 1.0))
    found.restart()
    assert not found.contains(TORQUE_REVERSAL)
    old = seen((-1.0, 1.0), (1.0, 1.0), (1.0, 1.0), (1.0, 1.0), step=1.1 * SLOW_FALL)
    assert not old.contains(TORQUE_REVERSAL)


def test_what_the_readings_contain_is_not_suggested():
    reversed_torque = seen((1.0, 1.0), (-0.5, 1.0))
    assert reversed_torque.remedy(F, UNRELATED, True) == WITHOUT_LOAD
    assert reversed_torque.remedy(G, UNRELATED, True) == ""
    assert reversed_torque.remedy(G, UNRELATED, False) == LONGER
    assert reversed_torque.remedy(B, UNRELATED, True) == ROTATION_REVERSAL
    assert seen((1.0, 1.0), (1.0, -1.0)).remedy(D, UNRELATED, True) == ""
    assert seen((1.0, 1.0), (1.0, 1.3)).remedy(J, UNRELATED, False) == SPEED_CHANGE


def test_reversing_duty_is_not_asked_for_reversal_of_the_torque():
    _, follower = balance_of("reversing", {}, 30.0, 5)
    assert all(one.remedy != TORQUE_REVERSAL for one in follower.estimates())
    _, steady = balance_of("steady", {}, 10.0, 5)
    remedies = {one.name: one.remedy for one in steady.estimates()}
    assert remedies["friction_level"] == remedies["torque_gain"] == TORQUE_REVERSAL


def test_without_balance_both_torques_and_a_speed_are_asked_for():
    _, time, columns = played("reversing", {}, 10.0, 5)
    del columns["output_torque"]
    follower = BalanceFollower(paper())
    follower.add(time, columns)
    remedies = {one.name: one.remedy for one in follower.estimates() if one.name != "input_torque"}
    assert set(remedies.values()) == {"both torques and a speed while the train turns"}
