"""`planetary-twin fields`: the fields of a scene with units, defaults and ranges."""

from __future__ import annotations

from typing import Annotated

import typer

from ..terminal.arguments import JsonOption
from ..terminal.json_output import console_beside, write_json
from ..terminal.messages import fail


def fields(
    part: Annotated[
        str,
        typer.Argument(
            metavar="PART", help="Text that the dotted name contains.", show_default="all fields"
        ),
    ] = "",
    json_: JsonOption = None,
) -> None:
    """List the fields of a scene, which --set, sweep and scene files accept.

    Fields of the operating point need no prefix operating_point. A round bracket excludes the end
    of a range.

    Example: planetary-twin fields mesh.damping
    """
    from rich.markup import escape

    from ..scene.fields import SceneField, scene_sections
    from ..terminal.tables import table

    sections = list(scene_sections())
    found = [
        (section.kind, field)
        for section in sections
        for field in section.fields
        if part in field.name
    ]
    if not found:
        names = ", ".join(field.name for field in sections[0].fields)
        fail(f"PART = {part!r}: no field name contains it; names start with {names}")
    rows = (
        [escape(text) for text in (f"{field.name} ({kind})" if kind else field.name, *field[1:])]
        for kind, field in found
    )
    console = console_beside(json_)
    shown = table(SceneField._fields, rows, texts=SceneField._fields)
    shown.columns[0].no_wrap = True
    console.print(shown)
    write_json([{"kind": kind, **field._asdict()} for kind, field in found], json_)
