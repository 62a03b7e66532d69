"""The report on a reduced grid, against numbers that others have published or computed."""

import numpy as np
import pytest
from planetary_twin_paper.evidence import gather
from planetary_twin_paper.page import figures, write_page
from planetary_twin_paper.report import entries
from planetary_twin_paper.study import Grid, largest

import planetary_twin_py as pt

pytestmark = [pytest.mark.slow, pytest.mark.exhaustive]

GRID = Grid(
    backlashes=(2e-7, 3.5e-7),
    lambda_ratios=(1.0, 1.5, 2.0),
    speeds=(1000.0, 2000.0, 3000.0),
    torques=(52.5, 63.0, 73.5),
)


@pytest.fixture(scope="module")
def evidence():
    return gather(GRID, 1)


@pytest.fixture(scope="module")
def found(evidence):
    return {entry.number: entry for entry in entries(evidence)}


VERDICTS = {
    "Table 1": "reproduced",
    "Table 2": "reproduced",
    "Table 3": "reproduced",  # conductivity in the printed form only
    "Table 4": "cannot be, because",
    "Table 5": "cannot be, because",  # the printed matrices give it within 1 %, not its digits
    "Figure 1": "reproduced",
    "Figure 2": "reproduced",
    "Figure 3": "trend reproduced",
    "Figure 4": "trend reproduced",
    "Figure 5": "reproduced",
    "Figure 6": "cannot be, because",  # by the laws of either scene
    "Figure 7": "trend reproduced",
    "Figure 8": "trend reproduced",
    "Figure 9": "cannot be, because",
    "Figure 10": "trend reproduced",
    "Figure 11": "trend reproduced",
    "Figure 12": "reproduced",
    "Figure 13": "trend reproduced",
    "Figure 14": "cannot be, because",
    "Sections 2, 9": "cannot be, because",
}


def test_verdicts(found):
    assert {number: str(entry.verdict) for number, entry in found.items()} == VERDICTS


def test_power_of_printed_friction_torque_is_twice_sliding_loss(found):
    values = found["Figure 11"].figures
    gain = values["ledger_efficiency_printed"] - 1.0
    assert gain.min() > 0.0
    assert gain / values["loss_ratio_printed"] == pytest.approx(np.full(gain.shape, 2.0), rel=0.01)


def test_frequencies_and_crossings(found):
    table, sweep, modes = (found[n].figures for n in ("Table 5", "Figure 13", "Figure 14"))
    assert table["literal"][1:] == pytest.approx([3684.70, 5905.24, 10065.84, 10065.84, 11931.01])
    assert table["twin"] == pytest.approx([0, 5500.36, 9375.70, 9375.70, 11112.99], abs=0.01)
    assert sweep["crossing_printed"] == pytest.approx(3.49e5, rel=2e-3)
    assert modes["stiffness_at_8643_hz"] == pytest.approx(2.0e7, rel=0.05)


def test_a_third_curve_of_figure_6_is_labelled_as_another(found):
    """A prescribed law of load sharing has the regimes, the scenes' own laws do not."""
    entry = found["Figure 6"]
    own, mixed = (entry.figures[f"friction_coefficient{name}"] for name in ("", "_mixed"))
    assert not any(claim.reached for claim in entry.claims)
    assert own.max() < 0.06 and np.all(np.diff(own[own.argmax() :]) < 0.0)
    assert mixed[0] > 0.08 and mixed.min() < mixed[0] / 2 and mixed[-1] > 2 * mixed.min()
    assert "another model than the paper's" in entry.remarks


def test_the_largest_force_is_not_limited_by_the_sampling(evidence):
    """Against eight times as many samples of a run with a hundredth of the tolerance."""
    scene = evidence.scene.replace(backlash=2e-7, lambda_ratio=1.0, input_speed=pt.rpm(2000.0))
    dense = pt.simulate(scene, 0.05, 3.2e6, tolerance=1e-6)
    peak = dense.mesh_force[dense.time > 0.04, :3].max()
    assert evidence.study.over_grid(lambda o: o.sun.largest_force)[0, 0, 1] == pytest.approx(
        peak, rel=1e-3
    )


def test_largest_value_that_samples_do_not_resolve_is_refused():
    with pytest.raises(ArithmeticError, match="does not resolve it"):
        largest(np.array([[0.0], [1.0], [0.5], [0.9]]))
    assert largest(np.array([[0.9995], [1.0], [0.9996], [0.2]])) == 1.0


def test_a_page_has_all_entries_and_is_the_same_a_second_time(found, evidence, tmp_path):
    for folder, its_entries in (("first", list(found.values())), ("second", entries(evidence))):
        (tmp_path / folder).mkdir()
        write_page(its_entries, evidence, tmp_path / folder / "paper.md")
    first, second = (
        {p.name: p.read_bytes() for p in (tmp_path / folder).rglob("*") if p.is_file()}
        for folder in ("first", "second")
    )
    assert first == second and len(first) == 15
    (tmp_path / "vector").mkdir()
    write_page(list(found.values()), evidence, tmp_path / "vector" / "paper.md", ".svg")
    page = (tmp_path / "vector" / "paper.md").read_text("utf-8")
    drawings = list((tmp_path / "vector" / "paper").glob("figure_*.svg"))
    assert len(drawings) == 14 and all(f"(paper/{svg.name})" in page for svg in drawings)
    data = figures(list(found.values()), evidence)
    assert len(data["entries"]) == len(VERDICTS)
    assert len(data["studies"]["paper"]) == 2 * 3 * 3 + 3
