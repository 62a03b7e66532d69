"""What a sensor receives of planets that pass it, against the series of the windows."""

import math

import numpy as np
import pytest

from planetary_twin_py.scene.sensors import TransferWindow
from planetary_twin_py.sensors.windows import window

SETS = {  # ring teeth, planets, and the expected orders over the largest one, for cos^8
    "21/39/99": (99, 3, {99: 1.0, 96: 8 / 70, 102: 8 / 70}),
    "17/37/91": (91, 3, {90: 1.0, 93: 0.5, 87: 1 / 56, 91: 0.0}),
    "28/36/100": (100, 4, {100: 1.0, 96: 1 / 70, 104: 1 / 70}),
    "20/40/100": (100, 3, {99: 1.0, 102: 0.5, 96: 1 / 56, 100: 0.0}),
}


TURN = math.tau / 4096 * np.arange(4096)


def coefficients(path, planets, most):
    """Fourier coefficients W_0 ... W_most of a window per turn of the carrier."""
    return np.fft.rfft(window(path, planets, TURN)).real[: most + 1] / len(TURN)


@pytest.mark.parametrize("power", [1, 4, 7])
def test_a_cosine_window_has_the_binomial_coefficients(power):
    """cos^2p(d/2) is the sum of C(2p, p + m) / 4^p exp(i m d)."""
    found = coefficients(TransferWindow(power=power), 3, 8)
    expected = [math.comb(2 * power, power + m) / 4**power if m <= power else 0 for m in range(9)]
    assert found == pytest.approx(expected, abs=1e-12)


@pytest.mark.parametrize("planets", [3, 4, 5])
def test_a_hann_lobe_has_its_fourier_integral(planets):
    """The integral of (1 + cos N d)/2 cos(m d) over a lobe, in closed form."""
    found = coefficients(TransferWindow(shape="hann"), planets, 5)
    b = math.pi / planets

    def transform(m):
        return b if m == 0 else math.sin(m * b) / m

    expected = [
        (0.5 * transform(m) + 0.25 * (transform(m - planets) + transform(m + planets))) / math.pi
        for m in range(6)
    ]
    assert found == pytest.approx(expected, abs=2e-6)  # the lobe has a kink in its second slope


@pytest.mark.parametrize("name", SETS)
def test_sidebands_follow_teeth_and_planets(name):
    """Of one mesh harmonic each, for equal planets: 2 |F W_m| |sum of exp(i k psi)|."""
    teeth, planets, expected = SETS[name]
    place = TURN[:, None] + math.tau / planets * np.arange(planets)
    force = np.cos(teeth * place)  # in the phase in which its teeth meet the ring
    received = (force * window(TransferWindow(), planets, place - 0.7)).sum(axis=1)
    lines = np.abs(np.fft.rfft(received))
    largest = max(expected, key=expected.get)
    for order, ratio in expected.items():
        assert lines[order] / lines[largest] == pytest.approx(ratio, abs=1e-6), order


def test_a_constant_share_is_added():
    assert window(TransferWindow(direct=0.3), 3, math.pi) == pytest.approx(0.3)
