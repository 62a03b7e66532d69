"""Write a scene as an FMU: model description, libraries and records in one archive."""

from __future__ import annotations

import re
import uuid
import zipfile
from importlib.metadata import version as version_of
from pathlib import Path

from .._core.levels import ARM, NEEDS
from ..run.steady_temperatures import with_start
from ..run.tolerance import LIVE_TOLERANCE
from ..scene import Scene
from ..scene.given import check_scene
from .description import Description, model_description_2, model_description_3
from .records import build_records, file_of, put_variables
from .variables import variables

VERSIONS = ("3.0", "2.0")
"""Supported versions of the Functional Mock-up Interface (FMI)."""
ADAPTERS, RECORDS = "fmi.so", "scene.bin"
LIBRARIES = Path(__file__).parent.parent / "_core" / "fmu"
NAMESPACE = uuid.UUID("d4f2c7b6-5a0f-5b55-9a3c-5f8a4c1d7e21")
EARLIEST = (1980, 1, 1, 0, 0, 0)  # constant date in the archive: the same scene gives the same file
PLATFORMS = {"3.0": "x86_64-linux", "2.0": "linux64"}
if NEEDS is ARM:  # for which FMI 2.0.4 (section 2.3) refers to the names of FMI 3.0
    PLATFORMS = dict.fromkeys(VERSIONS, "aarch64-linux")
"""Folder of the library, by version of FMI."""


def export_fmu(
    scene: Scene,
    path: str | Path,
    *,
    version: str = "3.0",
    tolerance: float = LIVE_TOLERANCE,
) -> Path:
    """Export a scene as a functional mock-up unit (FMU) for co-simulation.

    The FMU makes the same steps as `Twin.step`. It runs on Linux on processors of this kind,
    x86-64 or 64-bit ARM, without Python and without this package. Temperatures that are states and
    damage are outputs; damage starts at 0.

    Args:
        scene: scene with torsional dynamics and a fixed member; its ports determine the inputs.
        path: path of the file, which is written or replaced.
        version: version of FMI, one of `VERSIONS`.
        tolerance: relative local error tolerance, unless the importing tool sets another.

    Returns:
        The path.

    Raises:
        ValueError: an argument is out of range, or the scene cannot be exported.
        FileNotFoundError: the libraries have not been built.
        OSError: the file cannot be written.
    """
    check_scene(scene)
    scene = with_start(scene)
    if version not in VERSIONS:
        raise ValueError(f"version = {version!r}: must be {' or '.join(VERSIONS)}")
    _check(scene)
    exported = build_records(scene, tolerance)
    model_variables = variables(scene, exported)
    put_variables(exported, model_variables)
    records, levels = file_of(exported), _levels()
    identifier = re.sub(r"^(?=\d)|\W", "_", scene.name, flags=re.ASCII)
    about = Description(
        name=scene.name,
        identifier=identifier,
        text=f"planetary gearbox: {scene.name}",
        token=f"{{{uuid.uuid5(NAMESPACE, version + records.hex())}}}",
        tool=f"planetary_twin_py {version_of('planetary_twin_py')}",
        tolerance=tolerance,
        variables=model_variables,
    )
    write = model_description_3 if version == "3.0" else model_description_2
    files = {
        "modelDescription.xml": write(about),
        f"binaries/{PLATFORMS[version]}/{identifier}.so": _library(ADAPTERS),
        f"resources/{RECORDS}": records,
        **{f"resources/{level}.so": _library(f"{level}.so") for level in levels},
    }
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in files.items():
            entry = zipfile.ZipInfo(name, EARLIEST)
            entry.compress_type = zipfile.ZIP_DEFLATED
            archive.writestr(entry, content)
    return Path(path)


def exported_levels() -> list[str]:
    """Processor levels that an FMU of this installation contains, the best first.

    Returns:
        Names of the levels.
    """
    return [level for level in NEEDS if (LIBRARIES / f"{level}.so").exists()]


def _levels() -> list[str]:
    levels = exported_levels()
    if not levels:
        raise FileNotFoundError(f"{LIBRARIES}: has no libraries for an FMU: make setup")
    return levels


def _library(name: str) -> bytes:
    return (LIBRARIES / name).read_bytes()


def _check(scene: Scene) -> None:
    if scene.dynamics != "torsional":
        raise ValueError(f"dynamics = {scene.dynamics!r}: must be torsional for an FMU")
    if scene.gearset.held == "none":
        raise ValueError("gearset.held = 'none': must be sun, ring or carrier for an FMU")
    for n, fault in enumerate(scene.faults):
        if fault.growing is not None:
            raise ValueError(f"faults.{n}.growth: must be none for an FMU")
    if scene.drive.input.port == "brake":
        raise ValueError("drive.input.port = 'brake': must be machine, torque or motion for an FMU")
