"""Integrated powers and stored energy of a run at one time."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np


class EnergyBooks(NamedTuple):
    """Integrals of the powers up to a time, and the energies stored then."""

    ledger: np.ndarray
    """Integrals [J], (LEDGER,), see core/model/energy.hpp."""
    kinetic: float
    """Kinetic energy [J]."""
    elastic: float
    """Elastic energy, and potential energy of the weight [J]."""

    def since(self, before: EnergyBooks) -> EnergyBooks:
        """Return the differences from an earlier time of the same run."""
        return EnergyBooks(
            self.ledger - before.ledger,
            self.kinetic - before.kinetic,
            self.elastic - before.elastic,
        )
