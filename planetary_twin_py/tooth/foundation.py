"""The gear body under the root of a loaded tooth, as an elastic ring.

Sainsot, Velex and Duverger (2004) apply the stresses of the tooth on its root (linear for bending,
uniform for shear and compression) to an elastic ring that is held at its other edge. They solve it
by Muskhelishvili's method and fit L*, M*, P*, Q* to the result for 1.4 <= h <= 7 and root half
angles of 0.01 to 0.12 rad. This module sums the series itself, so there is no limit of the range,
internal gears are included (loaded at the inner edge and held at the outer), and the displacement
of the neighbouring tooth follows, too. P* and Q* agree with theirs within 10 %. The rotation L* is
5.2, as on Weber's half-plane, and not 6.9; it is closer to finite elements. Plane strain; all
lengths are in units of the root radius.

For each harmonic the displacement 2 G (u_r + i u_t) and the stress s_r - i s_rt are linear in four
potentials a r^(n+1), b r^(1-n), c r^(n-1), d r^(-n-1) (Muskhelishvili 1953, section 59); for n = 1
logarithms, which carry the net force, replace b.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Complex = NDArray[np.complex128]

HARMONICS = 40.0  # times 1/half angle of the root: the truncation error is below 1e-3


@dataclass(frozen=True)
class GearBody:
    """Ring between the root circle and the circle at which it is held."""

    held: float
    """Radius of the held circle [root radii]: below 1 for an external gear (hub), above 1 for an
    internal gear (housing)."""
    half_angle: float
    """Half angle of the root of a tooth [rad]."""
    poisson_ratio: float

    def compliance(self, neighbour: float = 0.0) -> Floats:
        """Compliance of the root of a tooth (method of Sainsot, Velex and Duverger 2004).

        Args:
            neighbour: angle from the loaded tooth to the displaced tooth [rad].

        Returns:
            Matrix of E times displacement over load per face width, in root radii, (3, 3). Rows:
            rotation of the root, displacements across and along the displaced tooth. Columns:
            moment about the middle of the root arc, force across and force towards the body on the
            loaded tooth. Displacements are means over the root, weighted so that load times
            displacement is work.
        """
        orders, factors = self._tractions()
        moved = self._response(orders, factors)
        turned = np.exp(1j * orders * neighbour)
        work = np.einsum("jn,n,kn->jk", factors.conj(), turned, moved).real
        return 2.0 * np.pi * (1.0 + self.poisson_ratio) * work

    def _tractions(self) -> tuple[Floats, Complex]:
        """Orders n (2 N + 1,) and Fourier factors (3, .) of p_r + i p_t of the three loads."""
        count = int(np.ceil(HARMONICS / self.half_angle))
        orders = np.arange(-count, count + 1, dtype=float)
        half, shifted = self.half_angle, orders + 1.0  # from the axes of the tooth to polar ones
        even = np.sinc(shifted * half / np.pi) / (2.0 * np.pi)
        odd = np.sinc(orders * half / np.pi) - np.sinc((orders + 2.0) * half / np.pi)
        odd *= half / (2.0 * np.pi) / (half - 0.5 * np.sin(2.0 * half))
        # Along the tooth p_x = sin(t)/(second moment), or 1/arc; across it p_y = 1/arc.
        outwards = 1.0 if self.held < 1.0 else -1.0
        return orders, np.array([1j * outwards * odd, 1j * even, -outwards * even])

    def _response(self, orders: Floats, factors: Complex) -> Complex:
        """Fourier factors (3, .) of 2 G (u_r + i u_t) on the root circle."""
        count = len(orders) // 2
        outwards = 1.0 if self.held < 1.0 else -1.0  # the normal is +-r
        stress = outwards * factors.conj()[:, ::-1]  # s_r - i s_rt of order n is conj of order -n
        harmonic = orders[count + 1 :]
        edge, moved = self._systems(harmonic)
        right = np.zeros((len(harmonic), 4, len(factors)), dtype=complex)
        right[:, 0] = stress[:, count + 1 :].T
        right[:, 1] = stress[:, :count][:, ::-1].conj().T
        displacement = moved @ np.linalg.solve(edge, right)
        response = np.empty_like(factors)
        response[:, count + 1 :] = displacement[:, 0].T
        response[:, :count] = displacement[:, 1].conj().T[:, ::-1]
        response[:, count] = self._mean(stress[:, count])
        return response

    def _systems(self, n: Floats) -> tuple[Floats, Floats]:
        """Boundary conditions (N, 4, 4), and displacements at r = 1 (N, 2, 4), of (a, b*, c, d*).

        The conditions give the stress at r = 1 and zero displacement at the held edge. The rows are
        the factors of exp(i n t) and the conjugates of those of exp(-i n t). Each column is scaled
        by its largest value, which is at one of the two edges.
        """
        kappa = 3.0 - 4.0 * self.poisson_ratio
        powers = np.stack([n + 1.0, 1.0 - n, n - 1.0, -n - 1.0], axis=-1)
        log_scale = np.maximum(0.0, powers * np.log(self.held))

        def displacement(radius: float) -> Floats:
            r = np.exp(powers * np.log(radius) - log_scale)
            zero = np.zeros_like(n)
            plus = np.stack([kappa * r[:, 0], (n - 1.0) * r[:, 1], zero, -r[:, 3]], axis=-1)
            minus = np.stack([-(n + 1) * r[:, 0], kappa * r[:, 1], -r[:, 2], zero], axis=-1)
            rows = np.stack([plus, minus], axis=1)
            rows[0, :, 1] = -1.0, 2.0 * kappa * np.log(radius)
            return rows

        column_scale = np.exp(-log_scale)
        plus = np.stack([1 - n**2, 1 - n, 1 - n, 0 * n], axis=-1) * column_scale
        minus = np.stack([n + 1, 1 - n**2, 0 * n, n + 1], axis=-1) * column_scale
        stress = np.stack([plus, minus], axis=1)
        stress[0, :, 1] = 1.0 + kappa, 2.0
        return np.concatenate([stress, displacement(self.held)], axis=1), displacement(1.0)

    def _mean(self, stress: Complex) -> Complex:
        """Order 0: radial expansion (real part) and rotation (imaginary part)."""
        kappa, held = 3.0 - 4.0 * self.poisson_ratio, self.held
        # s = 2 Re a + d; 2 G u = kappa a r - a* r - d*/r, which is zero at the held edge.
        expansion = stress.real / (2.0 + (kappa - 1.0) * held**2)
        radial = (kappa - 1.0) * expansion * (1.0 - held**2)
        rotation = stress.imag * (1.0 - held**-2)
        return radial + 1j * rotation
