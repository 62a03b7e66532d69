"""Names of the friction laws, from the field of the scene that selects one."""

from typing import get_args

from planetary_twin_py.scene.lubrication import Lubrication

FRICTION_LAWS: tuple[str, ...] = get_args(Lubrication.model_fields["traction"].annotation)
EXAMPLE_TABLE = {"lambda_ratio": [0.5, 2.0], "coefficient": [0.08, 0.05]}
