"""Figure 10: film thickness against speed."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.figure import Figure

from planetary_twin_py.plots.style import panels
from planetary_twin_py.scene import Scene
from planetary_twin_py.units.conversion import rpm

from .entry import Claim, Entry
from .evidence import Evidence
from .judge import rises
from .pitch_point import KINDS, RING, SUN, at_pitch_point

LAWS = {
    "salagianni": "(15)",
    "dowson_higginson": "Dowson-Higginson",
    "dowson_toyoda": "Dowson-Toyoda",
}


def film_thickness(evidence: Evidence) -> Entry:
    """Figure 10."""
    speeds = evidence.study.grid.speeds
    ours, printed = (
        [study.over_grid(lambda o: o.sun.film), study.over_grid(lambda o: o.ring.film)]
        for study in (evidence.study, evidence.printed_study)
    )
    laws = {law: _law(evidence.scene, law, speeds) for law in LAWS}
    own = laws["salagianni"]
    growth = own[SUN][-1] / own[SUN][0]
    share = own[SUN][0] / laws["dowson_higginson"][SUN][0]
    return Entry(
        number="Figure 10",
        title="film thickness against speed",
        claims=(
            Claim(
                says="film thickness increases with speed in both meshes",
                ours=_growth(ours),
                printed=_growth(printed),
                holds=all(rises(film, 2) for film in ours),
                printed_holds=all(rises(film, 2) for film in printed),
                why="the film thickness does not increase with speed",
            ),
        ),
        remarks="The film thickness is proportional to the speed to the power 0.7: at the pitch "
        f"point it increases by a factor of {growth:.4f} from {speeds[0]:g} to {speeds[-1]:g} rpm. "
        "The contact of planet and ring has a larger reduced radius than that of sun and planet, "
        f"so its film is {own[RING][0] / own[SUN][0]:.3f} times as thick. Equation (15) is the "
        f"minimum film thickness of Dowson and Higginson times {share:.3f}.",
        picture=_draw(evidence, ours, laws),
        figures={"at_pitch_point": laws},
    )


def _law(scene: Scene, law: str, speeds: Sequence[float]) -> list[list[float]]:
    """Film [m] at the pitch point of both kinds of mesh at `speeds` [rpm]."""
    chosen = scene.replace(**{"lubrication.film": law})
    at_speed = [chosen.replace(input_speed=rpm(speed)) for speed in speeds]
    return [[at_pitch_point(scene, kind).film for scene in at_speed] for kind in (SUN, RING)]


def _growth(films: Sequence[np.ndarray]) -> str:
    means = [1e6 * film.mean(axis=(0, 1)) for film in films]
    return "; ".join(
        f"{kind} {', '.join(f'{h:.3f}' for h in mean)} um"
        for kind, mean in zip(KINDS, means, strict=True)
    )


def _draw(
    evidence: Evidence, ours: Sequence[np.ndarray], laws: dict[str, list[list[float]]]
) -> Figure:
    figure, axes = panels(2, 2.8)
    speeds = evidence.study.grid.speeds
    for kind, place in enumerate(axes):
        place.plot(speeds, 1e6 * ours[kind].mean(axis=(0, 1)), "o-", label="mean of the runs")
        for law, name in LAWS.items():
            place.plot(speeds, 1e6 * np.array(laws[law][kind]), "--", lw=1, label=name)
        place.set_title(f"{'ab'[kind]}) {KINDS[kind]}")
        place.set_xlabel("input speed [rpm]")
        place.set_xticks(speeds)
        place.set_ylim(0, None)
    axes[0].set_ylabel("film thickness [um]")
    axes[1].legend(loc="lower right")
    return figure
