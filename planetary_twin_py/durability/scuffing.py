"""Contact temperature at which flanks scuff, from a test of the oil."""

from __future__ import annotations

CELSIUS = 273.15  # [K] of 0 degC
WELDING = 1.0  # X_W of case-hardened steel with up to a fifth of residual austenite


def scuffing_temperature(fzg_stage: int, viscosity: float) -> float:
    """Scuffing temperature of an FZG test A/8.3/90, as in ISO/TS 6336-20.

    Args:
        fzg_stage: failure load stage of the oil.
        viscosity: dynamic viscosity of the oil at its temperature [Pa s].

    Returns:
        80 degC + (0.85 + 1.4 X_W) X_L S^2, X_L being the viscosity in mPa s to the power of -0.05,
        and X_W = 1 [K].
    """
    oil = (1e3 * viscosity) ** -0.05
    return float(CELSIUS + 80.0 + (0.85 + 1.4 * WELDING) * oil * fzg_stage**2)


def margin(limit: float, contact: float, oil: float) -> float:
    """Rise to the scuffing temperature over the rise of the contact, both above the oil.

    Args:
        limit: scuffing temperature [K].
        contact: highest contact temperature [K].
        oil: temperature of the oil [K].
    """
    return (limit - oil) / (contact - oil)
