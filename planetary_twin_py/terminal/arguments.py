"""Arguments and options that several commands share, with their shell completion."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Annotated, Any

import typer

from .completion import scene_fields
from .output_files import PICTURES, STUDY_TABLES, TABLES, file_ending_in, output_file
from .unit_options import SECONDS

RECORDINGS = Path("recordings")
_PACKAGED = Path(__file__).parents[1] / "scene" / "packaged"


def complete_scene(incomplete: str) -> list[str]:
    """Names of packaged scenes; if none matches, the shell completes file names.

    They are listed without `planetary_twin_py.scene`, which takes too long to import.
    """
    return sorted(
        file.stem for file in _PACKAGED.glob("*.yaml") if file.stem.startswith(incomplete)
    )


def complete_recording(incomplete: str) -> list[str]:
    """Recordings in the folder of `incomplete` and in recordings/; otherwise file names."""
    typed = Path(incomplete)
    folder = typed if incomplete.endswith("/") else typed.parent
    found = {str(path) for start in (folder, RECORDINGS) for path in _recordings(start)}
    return sorted(path for path in found if path.startswith(incomplete))


def complete_setting(incomplete: str) -> list[str]:
    """Fields of a scene for NAME=VALUE; their values have no completion."""
    return [] if "=" in incomplete else [f"{name}=" for name in scene_fields(incomplete)]


def complete_parameter(incomplete: str) -> list[str]:
    """Parameters of a running twin that can change."""
    from ..scene.live import LIVE

    return [name for name in (*LIVE, "tolerance") if name.startswith(incomplete)]


def _recordings(folder: Path) -> Iterator[Path]:
    """MCAP files in `folder`, and its subfolders that contain MCAP files."""
    try:
        for path in folder.iterdir():
            if path.suffix == ".mcap" or (path.is_dir() and any(path.glob("*.mcap"))):
                yield path
    except OSError:
        return  # no completions


def file_option(content: str, *suffixes: str, name: str = "", **further: Any) -> Any:
    """Option that names a file of one of some formats.

    Args:
        content: what the file is for.
        suffixes: of the formats, with their dots.
        name: of the file in the help; empty: FILE, with the suffix if there is one format.
        further: arguments of `typer.Option`.
    """
    name = name or (f"FILE{suffixes[0]}" if len(suffixes) == 1 else "FILE")
    return typer.Option(metavar=name, help=content, callback=file_ending_in(*suffixes), **further)


def picture_option(content: str) -> Any:
    """Option that names a picture.

    Args:
        content: what the picture shows.
    """
    return file_option(content, *PICTURES, name="FILE.png")


def table_option(content: str, ending: str = "to a .csv, .parquet or .npz table.") -> Any:
    """Option that names a table.

    Args:
        content: the start of a sentence on what is written.
        ending: its end.
    """
    return file_option(f"{content} {ending}", *TABLES)


def values_option(content: str, default: str) -> Any:
    """Option with values of a field, as those of a sweep.

    Args:
        content: what the values are.
        default: what is in place of them.
    """
    text = f"{content}, written as for sweep."
    return typer.Option(metavar="VALUES", help=text, show_default=default)


SceneArgument = Annotated[
    str,
    typer.Argument(
        metavar="SCENE",
        help="Name of a packaged scene, or path of a YAML file.",
        autocompletion=complete_scene,
    ),
]
FileArgument = Annotated[
    Path,
    typer.Argument(
        metavar="FILE",
        help="Recording: an .mcap file, or its folder.",
        autocompletion=complete_recording,
    ),
]
SetOption = Annotated[
    list[str] | None,
    typer.Option(
        "--set",
        metavar="NAME=VALUE",
        help="Change a field, in SI or with a unit: mesh.ramp=0, backlash=0.3um, faults.0.tooth=3. "
        "Write lists as in a scene file; null removes an optional field. Repeatable. "
        "`planetary-twin fields` lists the fields.",
        autocompletion=complete_setting,
    ),
]
StudyTable = Annotated[
    Path,
    typer.Option(help="Table (.parquet with units, .csv).", callback=file_ending_in(*STUDY_TABLES)),
]
StudyPicture = Annotated[
    Path, typer.Option(help="Picture: .png, .svg or .pdf.", callback=file_ending_in(*PICTURES))
]
StudyOut = Annotated[
    Path,
    typer.Option(
        help="Table (.parquet with units, .csv) or picture (.png, .svg, .pdf).",
        callback=file_ending_in(*STUDY_TABLES, *PICTURES),
    ),
]
EvaluatedOption = Annotated[float, typer.Option(help="Evaluated time of each run.", **SECONDS)]
SettlingOption = Annotated[float, typer.Option(help="Simulated time before.", **SECONDS)]
DurationOption = Annotated[float, typer.Option(help="Simulated time.", **SECONDS)]
JsonOption = Annotated[
    str | None,
    typer.Option(
        "--json",
        metavar="FILE",
        help="Write the results as JSON; - writes to standard output.",
        callback=output_file,
    ),
]
NamespaceOption = Annotated[
    str | None,
    typer.Option("--namespace", help="Namespace of the gearbox, if the recording has several."),
]
ToleranceOption = Annotated[
    float, typer.Option(help="Relative local error tolerance of the integrator.")
]
