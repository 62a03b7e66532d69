"""Arguments and options that several commands take, and how a shell completes them."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Annotated

import typer

from ._output import output_file

RECORDINGS = Path("recordings")
_PACKAGED = Path(__file__).parents[1] / "scene" / "packaged"


def complete_scene(incomplete: str) -> list[str]:
    """Names of packaged scenes; where none fits, the shell offers files.

    Listed without `planetary_twin_py.scene`, which takes longer to load than a person waits.
    """
    return sorted(
        file.stem for file in _PACKAGED.glob("*.yaml") if file.stem.startswith(incomplete)
    )


def complete_recording(incomplete: str) -> list[str]:
    """Recordings where `incomplete` points to and in recordings/; else the shell offers files."""
    typed = Path(incomplete)
    folder = typed if incomplete.endswith("/") else typed.parent
    found = {str(path) for start in (folder, RECORDINGS) for path in _recordings(start)}
    return sorted(path for path in found if path.startswith(incomplete))


def _recordings(folder: Path) -> Iterator[Path]:
    """MCAP files in `folder`, and folders in it that hold some."""
    try:
        for path in folder.iterdir():
            if path.suffix == ".mcap" or (path.is_dir() and any(path.glob("*.mcap"))):
                yield path
    except OSError:
        return  # nothing to offer


SceneArgument = Annotated[
    str,
    typer.Argument(
        metavar="SCENE",
        help="Packaged scene, or path of a YAML file.",
        autocompletion=complete_scene,
    ),
]
FileArgument = Annotated[
    Path,
    typer.Argument(
        metavar="FILE",
        help="Recording: an .mcap file or the folder of one.",
        autocompletion=complete_recording,
    ),
]
SetOption = Annotated[
    list[str] | None,
    typer.Option(
        "--set",
        metavar="NAME=VALUE",
        help="Change a field, in SI or with a unit: mesh.ramp=0, backlash=0.3um, faults.0.tooth=3; "
        "lists as in a scene file; repeatable. `planetary-twin fields` lists them.",
    ),
]
JsonOption = Annotated[
    str | None,
    typer.Option(
        "--json", metavar="FILE", help="Write figures; - prints them.", callback=output_file
    ),
]
NamespaceOption = Annotated[
    str | None, typer.Option("--namespace", help="Which gearbox, if the recording holds several.")
]
ToleranceOption = Annotated[float, typer.Option(help="Relative local error of a step.")]
