"""`planetary-twin temperature`: steady temperatures, their stability and feedback gain."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from ..terminal.arguments import (
    JsonOption,
    SceneArgument,
    SetOption,
    picture_option,
    values_option,
)
from ..terminal.console import progress
from ..terminal.figures import keyed, rows
from ..terminal.json_output import console_beside, write_json
from ..terminal.messages import need, one_line_errors, warn
from ..terminal.output_files import writing
from ..terminal.settings import scene_with
from ._study import axis

if TYPE_CHECKING:
    from ..scene import Scene


def temperature(
    scene: SceneArgument,
    input_torque: Annotated[str | None, values_option("Input torques", "operating point")] = None,
    input_speed: Annotated[str | None, values_option("Input speeds", "operating point")] = None,
    set_: SetOption = None,
    out: Annotated[Path | None, picture_option("Draw the temperature of the oil.")] = None,
    json_: JsonOption = None,
) -> None:
    """Steady temperatures of SCENE over load and speed: all states, stable or not.

    The scene must have the section thermal. The losses over temperature are those of quasi-static
    running with held axes, without faults, errors and ripple. The gain is how much a change of a
    temperature changes the losses that cause it: changes decay as 1 - gain, above 1 they grow.

    Example: planetary-twin temperature joint.yaml --input-torque 1:20:5 --out map.png
    """
    if out is not None:
        need("plots", "matplotlib")
    from ..studies.temperature import steady_map
    from ..terminal.tables import table
    from ..units.shown import STEADY

    with one_line_errors(ArithmeticError):
        loaded = scene_with(scene, set_)
        torques = _values(loaded, "input_torque", input_torque)
        speeds = _values(loaded, "input_speed", input_speed)
        with progress("operating points", len(torques) * len(speeds)) as advance:
            found = steady_map(loaded, torques, speeds, advance)
    console = console_beside(json_)
    states = [row for point in found for row in point.rows()]
    if states:
        numbers = [f"{number}" for number in range(1, len(states) + 1)]
        console.print(table(("", *numbers), rows(STEADY, *states), title="Steady states"))
    warn([remark for point in found if (remark := point.remark())])
    if out is not None:
        from ..plots.style import save
        from ..plots.temperature import temperature_diagram

        with writing("--out", out):
            save(temperature_diagram(loaded, found), str(out))
    write_json({"states": [keyed(STEADY, row) for row in states]}, json_)


def _values(scene: Scene, field: str, text: str | None) -> tuple[float, ...]:
    """Values of a field: those of the text, or that of the scene."""
    from ..studies.axes import Axis

    if text is None:
        return (float(getattr(scene.operating_point, field)),)
    found = axis(scene, field, text)
    if not isinstance(found, Axis):
        name = f"--{field.replace('_', '-')}"
        raise ValueError(f"{name} = {text!r}: must be a list or a range with a number of values")
    return tuple(map(float, found.values))
