"""How slowly gears creep."""

CREEPING = 5e-3  # [m/s] rolling speed at the pitch point below which tooth pairs hold
