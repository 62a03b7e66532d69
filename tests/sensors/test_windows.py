"""What a sensor receives of planets that pass it, against the series of the windows."""

import math

import numpy as np
import pytest

from planetary_twin_py.scene.sensors import TransferWindow
from planetary_twin_py.sensors.windows import window

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


def test_a_constant_share_is_added():
    assert window(TransferWindow(direct=0.3), 3, math.pi) == pytest.approx(0.3)
