"""The gear body under the root of a loaded tooth, as an elastic ring.

Sainsot, Velex and Duverger (2004) put the stresses that the tooth passes on to its root (linear
in bending, uniform in shear and compression) on an elastic ring held at its other edge, solved
it after Muskhelishvili, and fitted L*, M*, P*, Q* to the result for 1.4 <= h <= 7 and root half
angles of 0.01 to 0.12 rad. Here the series itself is summed: no range, external and internal
gears alike (an internal gear is loaded at the inner edge and held at the outer), and the
neighbouring tooth's share comes with it. P* and Q* are theirs within a tenth; the rotation
L* is 5.2 as on Weber's half-plane, not 6.9, which against finite elements is the better value.
Plane strain; all lengths in units of the root radius.

Per harmonic the displacement 2 G (u_r + i u_t) and the stress s_r - i s_rt are linear in four
potentials a r^(n+1), b r^(1-n), c r^(n-1), d r^(-n-1) (Muskhelishvili 1953, section 59); for n = 1
the logarithms that carry a net force take the place of b.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Complex = NDArray[np.complex128]

HARMONICS = 40.0  # times 1/half angle of the root: what is left out is below 1e-3


@dataclass(frozen=True)
class GearBody:
    """Ring between the root circle and the circle at which it is held.

    `held` is the radius of that circle in root radii: below 1 for an external gear (its hub),
    above 1 for an internal gear (its housing). `half_angle` [rad] is that of the tooth's root.
    """

    held: float
    half_angle: float
    poisson_ratio: float

    def compliance(self, neighbour: float = 0.0) -> Floats:
        """Matrix (3, 3) of E times displacement over load per face width, in root radii.

        Rows: rotation of a tooth's root, its displacements across and along the tooth. Columns:
        moment about the middle of the root arc, force across, force towards the body. The loads
        are on the tooth, the displacements those of the tooth at the angle `neighbour` [rad] from
        it, each in the axes of its own tooth; they are means over the root, weighted so that load
        times displacement is work.
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
        found = moved @ np.linalg.solve(edge, right)
        response = np.empty_like(factors)
        response[:, count + 1 :] = found[:, 0].T
        response[:, :count] = found[:, 1].conj().T[:, ::-1]
        response[:, count] = self._mean(stress[:, count])
        return response

    def _systems(self, n: Floats) -> tuple[Floats, Floats]:
        """Conditions (N, 4, 4) on (a, b*, c, d*): stress at r = 1 and no displacement where held.

        With them what gives the displacements at r = 1, (N, 2, 4). The rows are the factors of
        exp(i n t) and the conjugates of those of exp(-i n t). Each column is scaled by its
        largest value, which is at one of the two edges.
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

        one = np.exp(-log_scale)
        plus = np.stack([1 - n**2, 1 - n, 1 - n, 0 * n], axis=-1) * one
        minus = np.stack([n + 1, 1 - n**2, 0 * n, n + 1], axis=-1) * one
        stress = np.stack([plus, minus], axis=1)
        stress[0, :, 1] = 1.0 + kappa, 2.0
        return np.concatenate([stress, displacement(self.held)], axis=1), displacement(1.0)

    def _mean(self, stress: Complex) -> Complex:
        """Order 0: breathing (real part) and turning against the held edge (imaginary)."""
        kappa, held = 3.0 - 4.0 * self.poisson_ratio, self.held
        # s = 2 Re a + d; 2 G u = kappa a r - a* r - d*/r, which vanishes where held.
        breathing = stress.real / (2.0 + (kappa - 1.0) * held**2)
        radial = (kappa - 1.0) * breathing * (1.0 - held**2)
        turning = stress.imag * (1.0 - held**-2)
        return radial + 1j * turning
