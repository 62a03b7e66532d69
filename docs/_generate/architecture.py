"""Draws docs/architecture.svg: what the folders are, and which way data flows.

Run it to redraw the picture: python docs/_generate/architecture.py
"""

from pathlib import Path
from typing import NamedTuple
from xml.sax.saxutils import escape

FILE = Path(__file__).parents[1] / "architecture.svg"
WIDTH, HEIGHT = 860, 560


class Box(NamedTuple):
    """A part: its folders, what it does, and where it stands."""

    title: str
    does: str
    x: int
    y: int
    width: int
    colour: str

    @property
    def middle(self) -> int:
        """Of its width."""
        return self.x + self.width // 2


TALL = 58
MODEL, RUN, ROS, OUT = "#dbe9f6", "#fde3c8", "#e3d9f2", "#dcefd9"
SCENE = Box("scene/", "what is simulated: YAML, checked, in SI", 220, 16, 420, MODEL)
LAWS = Box("gearset/  tooth/  mesh/  core/lubrication/", "laws, one per file", 220, 106, 420, MODEL)
DYNAMICS = Box(
    "model/  core/model/  core/mesh/",
    "bodies and meshes as arrays; forces; contact events; energy",
    220,
    196,
    420,
    MODEL,
)
MODAL = Box("modal/", "natural modes", 680, 196, 164, MODEL)
STATIC = Box("statics/  core/quasi_static/", "equilibrium", 4, 286, 202, RUN)
MARCH = Box(
    "core/integrators/", "one step: collocation, rosenbrock; integrator: events", 220, 286, 420, RUN
)
TWIN = Box("run/", "Twin: stepped live", 220, 376, 200, RUN)
WHOLE = Box("simulation/", "a whole run; many", 440, 376, 200, RUN)
NODES = Box("ros_ws/src/planetary_twin", "paces, publishes, records, replays", 16, 476, 260, ROS)
RECORDS = Box("recording/  view/  robot/", "MCAP in and out; Rerun; URDF", 296, 476, 260, OUT)
STUDIES = Box("studies/  analysis/  plots/", "sweep, fit, spectra; pictures", 576, 476, 268, OUT)
BOXES = (
    SCENE, LAWS, DYNAMICS, MODAL, STATIC, MARCH, TWIN, WHOLE, NODES, RECORDS, STUDIES,
)  # fmt: skip
ARROWS = (
    (SCENE, LAWS), (LAWS, DYNAMICS), (LAWS, MODAL), (DYNAMICS, MARCH), (DYNAMICS, STATIC),
    (MARCH, TWIN), (MARCH, WHOLE), (STATIC, TWIN), (TWIN, NODES), (TWIN, RECORDS),
    (WHOLE, RECORDS), (WHOLE, STUDIES),
)  # fmt: skip


def picture() -> str:
    """The drawing as SVG."""
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" '
        f'font-family="sans-serif" text-anchor="middle">\n'
        '<defs><marker id="tip" viewBox="0 0 8 8" refX="8" refY="4" markerWidth="8" '
        'markerHeight="8" orient="auto"><path d="M0 0L8 4L0 8z" fill="#555"/></marker></defs>\n'
        f'<rect width="{WIDTH}" height="{HEIGHT}" fill="white"/>\n'
        + "".join(_arrow(*pair) for pair in ARROWS)
        + "".join(map(_box, BOXES))
        + "</svg>\n"
    )


def _box(box: Box) -> str:
    return (
        f'<rect x="{box.x}" y="{box.y}" width="{box.width}" height="{TALL}" rx="6" '
        f'fill="{box.colour}" stroke="#555"/>\n'
        f'<text x="{box.middle}" y="{box.y + 25}" font-size="15" font-weight="bold">'
        f"{escape(box.title)}</text>\n"
        f'<text x="{box.middle}" y="{box.y + 45}" font-size="13">{escape(box.does)}</text>\n'
    )


def _arrow(source: Box, target: Box) -> str:
    return (
        f'<line x1="{source.middle}" y1="{source.y + TALL}" x2="{target.middle}" '
        f'y2="{target.y - 1}" stroke="#555" stroke-width="1.5" marker-end="url(#tip)"/>\n'
    )


if __name__ == "__main__":
    FILE.write_text(picture())
