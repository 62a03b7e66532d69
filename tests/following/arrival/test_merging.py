"""Readings of several senders: their order of arrival changes nothing."""

import numpy as np
import pytest
from tiers import first

from planetary_twin_py.following.arrival.merging import OIL_DELAY, START, WAIT, Merge

TIME = np.arange(2000) / 100.0
CHANCE = np.random.default_rng(0)
SENT = {
    "motor": (TIME, {"input_torque": CHANCE.normal(63.0, 0.1, 2000)}),
    "load": (TIME[::2], {"output_torque": CHANCE.normal(146.0, 0.1, 1000)}),
    "oil": (TIME[::50], {"oil_temperature": 343.0 + 0.05 * TIME[::50]}),
}


def merged(delays, cuts=1):
    """All bins, where the messages of each sender arrive with a delay [s] by their stamps."""
    merge, found = Merge(0.1, {}), []
    arriving = [
        (time + delays[name](time), name, n)
        for name, (times, _) in SENT.items()
        for n, time in enumerate(times)
    ]
    arriving.sort(key=lambda one: one[0])
    for part in np.array_split(np.arange(len(arriving)), len(arriving) // cuts):
        for name in SENT:
            rows = [n for k in part for _, own, n in [arriving[k]] if own == name]
            time, columns = SENT[name][0][rows], SENT[name][1]
            if rows:
                found += merge.add(time, {key: v[rows] for key, v in columns.items()}, name)
    found += merge.finish()
    return found, merge.counters


def at_once(time):
    return 0.0 * time


def stalling(begin, length):
    """Messages of a while all arrive at its end, in their order."""
    return lambda time: begin + length - time if begin <= time < begin + length else 0.0


@pytest.mark.parametrize("late", first(1, ["motor", "load", "oil"]))
@pytest.mark.parametrize("begin", first(1, [7.3, 0.0, 19.0]))
def test_same_bits_while_messages_of_sender_arrive_second_later(late, begin):
    expected, counters = merged(dict.fromkeys(SENT, at_once))
    delays = dict.fromkeys(SENT, at_once) | {late: stalling(begin, 1.0)}
    found, others = merged(delays)
    assert repr(found) == repr(expected)
    assert others == counters and counters.late == 0
    assert repr(merged(delays, cuts=40)[0]) == repr(expected)
    assert [one.number for one in expected] == list(range(200))
    assert all({"input_torque", "output_torque", "oil_temperature"} == {*b.means} for b in found)


def _rows(columns, rows):
    return {name: values[rows] for name, values in columns.items()}


def test_a_silent_sender_holds_the_others_up_for_a_short_time():
    merge, newest = Merge(0.1, {}), -1
    times, columns = SENT["load"]
    half = times < 5.0
    for n, time in enumerate(TIME):
        row = np.flatnonzero((times == time) & half)
        list(merge.add(times[row], _rows(columns, row), "load"))
        for found in merge.add(TIME[n : n + 1], _rows(SENT["motor"][1], [n]), "motor"):
            newest = found.number
        if time > START + 0.3:
            assert 0.1 * (newest + 1) >= time - 0.31 - WAIT
            assert 0.1 * (newest + 1) >= time - 0.31 or 5.0 < time < 5.0 + WAIT + 0.31
    assert merge.counters.late == 0
    assert list(merge.add(times[~half], _rows(columns, ~half), "load")) == []
    assert merge.counters.late == pytest.approx(np.sum(~half), abs=30)  # the rest is in open bins


def test_an_oil_temperature_is_used_five_seconds_later():
    found, _ = merged(dict.fromkeys(SENT, at_once))
    oil = np.array([one.means["oil_temperature"].value for one in found])
    begin = np.array([0.1 * one.number for one in found])
    expected = 343.0 + 0.05 * np.maximum(np.floor((begin - OIL_DELAY + 1e-9) * 2.0) / 2.0, 0.0)
    assert oil == pytest.approx(expected, abs=1e-9)
