"""The eigenproblem as printed: (37) and (38), Table 5, Figures 13 and 14."""

import math

import numpy as np
import pytest

from planetary_twin_py.modal.modes import modes_of
from planetary_twin_py.modal.printed import EQUATION_37, FITTED_TO_TABLE_5, printed_model

TABLE_5 = [0, 3687, 5956, 10070, 10070, 11948]


def stiffness_sweep(data, sun_planet):
    """Natural frequencies [Hz] at each sun-planet stiffness [N/m], (values, modes)."""
    return np.array(
        [modes_of(printed_model(data._replace(sun_planet=k))).frequencies for k in sun_planet]
    )


def test_matrices_are_those_of_37_and_38():
    model = printed_model(EQUATION_37)
    assert model.mass == pytest.approx([0.272, 0.1, 0.1, 0.1, 0.759, 1.5])
    k = 1e8 * np.array(
        [
            [6, -2, -2, -2, 0, 0],
            [-2, 4, 0, 0, -2, 0],
            [-2, 0, 4, 0, -2, 0],
            [-2, 0, 0, 4, -2, 0],
            [0, -2, -2, -2, 6, 0],
            [0, 0, 0, 0, 0, 8.04],
        ]
    )
    assert model.stiffness == pytest.approx(k)


def test_their_frequencies_are_not_those_of_table_5():
    found = modes_of(printed_model(EQUATION_37)).frequencies
    assert found == pytest.approx([0, 3684.70, 5905.24, 10065.84, 10065.84, 11931.01], abs=0.01)
    assert np.all(np.abs(found[1:] - TABLE_5[1:]) > 2.0)


def test_table_5_follows_from_other_inertias_cut_to_whole_hertz():
    found = modes_of(printed_model(FITTED_TO_TABLE_5)).frequencies
    assert np.floor(found) == pytest.approx(TABLE_5)


def test_ring_and_inertias_of_table_4_give_neither():
    table_4 = EQUATION_37._replace(ring=0.779)
    found = modes_of(printed_model(table_4)).frequencies
    assert found[[2, 5]] == pytest.approx([5876.10, 11923.85], abs=0.01)
    halved = EQUATION_37._replace(sun=0.136, planet=0.05, ring=0.389, carrier=0.75)
    found = modes_of(printed_model(halved)).frequencies
    assert found[1:] == pytest.approx([5210.96, 8312.07, 14235.25, 14235.25, 16863.36], abs=0.01)


def test_carrier_is_a_mode_of_its_own():
    modes = modes_of(printed_model(EQUATION_37))
    carrier = modes.frequencies[np.abs(modes.shapes[-1]).argmax()]
    assert carrier == pytest.approx(math.sqrt(8.04e8 / 1.5) / (2 * math.pi))


def test_second_mode_of_figure_13_grows_as_root_of_the_stiffness():
    values = np.array([1.5e3, 5e3, 1.5e4])
    found = stiffness_sweep(EQUATION_37, values)
    assert found[:, 1] == pytest.approx(0.5926 * np.sqrt(values), rel=1e-4)
    assert found[[0, -1], 1] == pytest.approx([22.95, 72.57], abs=0.01)
    assert found[:, 2] == pytest.approx(3684.70, abs=0.01)
    assert found[[0, -1], 3] == pytest.approx([7117.65, 7117.89], abs=0.01)
    assert found[[0, -1], 5] == pytest.approx([8407.4, 8407.6], abs=0.1)


def test_figure_14_has_23_hz_and_8643_a_thousand_times_further():
    fitted = stiffness_sweep(FITTED_TO_TABLE_5, [1.5e3])[0]
    assert fitted[1] == pytest.approx(23.03, abs=0.01)
    upper = stiffness_sweep(EQUATION_37, [1.5e4, 2.0e7])
    assert upper[0].max() < 8470.0
    assert upper[1].max() == pytest.approx(8643.0, abs=5.0)


def test_second_mode_is_far_beyond_the_printed_range():
    assert stiffness_sweep(EQUATION_37, [3.49e5])[0, 1] == pytest.approx(350.0, abs=0.5)
    assert stiffness_sweep(EQUATION_37, [7.13e5])[0, 1] == pytest.approx(500.0, abs=0.5)
