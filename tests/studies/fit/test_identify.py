"""Identification of known parameters from recordings."""

import numpy as np
import pytest
from studies.fit.rig import LIGHT, PAPER, record

from planetary_twin_py.studies.fit.excerpt import read_excerpt
from planetary_twin_py.studies.fit.identify import Search, identify
from planetary_twin_py.studies.fit.remarks import remarks

ELSEWHERE = {"backlash": 6e-7, "lambda_ratio": 2.0, "input_torque": 45.0}


def find(path, *free, begin=None, end=None, **search):
    start = {name: value for name, value in ELSEWHERE.items() if name in free}
    return identify(path, Search(free, start=start, **search), begin=begin, end=end)


@pytest.mark.exhaustive
def test_rattle_identifies_the_backlash(tmp_path):
    errors = []
    for seed in range(3):
        path = record(tmp_path / str(seed), LIGHT, 0.1, seed, share=0.01)
        found = find(path, "backlash", confidence=0.999)
        low, high, _ = found.estimate.intervals[0]
        assert low < 2e-7 < high and high - low < 0.1e-7
        assert found.contact_fraction < 1.0 and list(remarks(found)) == []
        errors.append((found.estimate.values[0] - 2e-7) / (high - low) * 2.0 * 3.3)
    assert abs(np.mean(errors)) < 3.0 / np.sqrt(3.0)


@pytest.mark.slow
def test_steady_load_shows_torque_and_film_but_not_backlash(tmp_path):
    path = record(tmp_path / "bag", PAPER, 0.1, 0, share=0.003)
    found = find(path, "backlash", "lambda_ratio", "input_torque", confidence=0.999)
    assert found.estimate.not_identifiable == ((0,),)
    for place, truth in ((1, 1.0), (2, 63.0)):
        low, high, _ = found.estimate.intervals[place]
        assert low < truth < high
    warnings = list(remarks(found))
    assert len(warnings) == 1
    assert warnings[0].startswith(
        "backlash: not identifiable from this excerpt: teeth never separate (contact_fraction = 1)"
        "; all values from 0 to "
    )
    assert np.isnan(found.estimate.correlation[0]).all()


@pytest.mark.exhaustive
@pytest.mark.slow
def test_the_truth_is_found_through_a_change_that_still_rings(tmp_path):
    changes = [(0.1, {"input_torque": 40.0})]
    path = record(tmp_path / "bag", PAPER, 0.3, changes=changes)
    found = find(path, "lambda_ratio", "input_torque", begin=0.2, end=0.3)
    assert found.excerpt.begins == 0.0 and found.excerpt.held_from == pytest.approx(0.1)
    assert found.estimate.values == pytest.approx([1.0, 40.0], rel=1e-4)


@pytest.mark.slow
def test_the_waveform_identifies_more_than_its_rms(tmp_path):
    path = record(tmp_path / "bag", PAPER, 0.1, 0, share=0.05)
    widths = []
    for observe in (("dte_waveform",), ("dte_rms",)):
        found = find(path, "mesh.double_pair_ratio", observe=observe, confidence=0.999)
        low, high, _ = found.estimate.intervals[0]
        assert low < 1.75 < high
        widths.append(high - low)
    assert widths[0] < widths[1]


def test_the_longest_interval_without_a_change_is_used(tmp_path):
    changes = [(0.08, {"lambda_ratio": 1.5}), (0.09, {"lambda_ratio": 1.2})]
    path = record(tmp_path / "bag", PAPER, 0.2, changes=changes)
    found = read_excerpt(path)
    assert (found.start, found.end) == (0.0, 0.08)
    found = read_excerpt(path, begin=0.05, end=0.15)
    assert (found.start, found.end) == (0.05, 0.15)
    assert found.segments == pytest.approx((0.08, 0.09))


@pytest.mark.parametrize(
    ("search", "reason"),
    [
        (Search(()), "no free parameter"),
        (Search(("nosuch",)), "nosuch: no such field"),
        (Search(("gearset.teeth.sun",)), "gearset.teeth.sun = 30: only a continuous quantity"),
        (Search(("backlash",), start={"backlash": 1.0}), "backlash = 1.0: must be a number within"),
        (Search(("backlash",), ("noise",)), "observe = noise: must be one of"),
        (Search(("backlash",), confidence=1.0), "confidence = 1.0: must be between 0 and 1"),
        (Search(("backlash",), ("second_input_speed",)), "was not recorded in this excerpt"),
        (
            Search(("backlash", "lambda_ratio"), ("power_loss",)),
            "1 mean readings do not determine 2",
        ),
    ],
)
def test_an_impossible_estimate_is_refused_in_one_line(short, search, reason):
    with pytest.raises(ValueError) as refusal:
        identify(short, search)
    assert reason in str(refusal.value) and "\n" not in str(refusal.value)


@pytest.fixture(scope="module")
def short(tmp_path_factory):
    return record(tmp_path_factory.mktemp("short") / "bag", PAPER, 0.05)
