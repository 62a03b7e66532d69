"""Layout of the screen: gears and changes on the left, plots in tabs on the right."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Literal, NamedTuple

import rerun.blueprint as rrb

from ..robot.parts import carrier_radius
from ..scene.gearset import Gearset
from ..units.catalogue import (
    BEARING,
    MEMBERS,
    MESH,
    OPERATING_POINT,
    OVERVIEW,
    PAGES,
    SHARING,
    TRAIN_PLOTS,
    WAVEFORM,
    WAVEFORM_VIEWS,
)
from . import orbits as orbit
from . import phase_portrait, spectra
from .axes import Scales
from .chart import BACKGROUND as CHART
from .chart import bounds
from .flanks import SIZE as STRIPS_SIZE
from .flanks import Shown
from .followed import ALONE, EVENTS, PAIRS, PLACE
from .gears import MILLIMETRES
from .overlay import DIFFERENCE
from .plots import PLOTTED_OF_AXES
from .timeline import SIMULATED_TIME

PLAYBACK_SPEED = 0.02  # slow motion, because the eye cannot follow the teeth at full speed
BACKGROUND = (24, 27, 33)
_ZOOM = 5_000_000  # [ns] of the waveform on either side of the time cursor


class Mode(NamedTuple):
    """Variant of the layout."""

    play_state: Literal["paused", "following"]
    menu: Literal["expanded", "hidden"]


FILE, PICTURE = Mode("paused", "expanded"), Mode("paused", "hidden")
LIVE = Mode("following", "expanded")


def blueprint(
    gearset: Gearset | None,
    mode: Mode = FILE,
    compared: str | None = None,
    axes: Scales | None = None,
    *,
    followed: bool = False,
    flanks: Sequence[Shown] = (),
    pages: Sequence[rrb.Container | rrb.View] = (),
) -> rrb.Blueprint:
    """Make the layout of a view.

    Args:
        gearset: gears to show; None shows no gears.
        mode: variant.
        compared: name of the reference recording, if there are several.
        axes: how axes that move are drawn; None if they are held.
        followed: whether there is a measured gearbox beside the twin.
        flanks: quantities of the strips of flanks.
        pages: further pages, after the others.

    Returns:
        The Rerun blueprint.
    """
    changes = rrb.TextLogView(
        origin="changes",
        name="Changes of the operating point",
        columns=rrb.TextLogColumns(text_log_columns=["Body"]),
    )
    left: rrb.TextLogView | rrb.Vertical = changes
    if gearset is not None:
        left = rrb.Vertical(_gears(gearset, axes), changes, row_shares=[4, 1])
    return rrb.Blueprint(
        rrb.Horizontal(
            left,
            _tabs(
                gearset,
                compared,
                axes,
                followed=followed,
                flanks=flanks,
                pages=pages,
            ),
            column_shares=[5, 6],
        ),
        rrb.TimePanel(
            state="collapsed",
            timeline=SIMULATED_TIME,
            playback_speed=PLAYBACK_SPEED,
            play_state=mode.play_state,
        ),
        rrb.TopPanel(state=mode.menu),
        rrb.BlueprintPanel(state="collapsed"),
        rrb.SelectionPanel(state="collapsed"),
        auto_views=False,
        auto_layout=False,
    )


def _gears(gearset: Gearset, axes: Scales | None) -> rrb.Spatial3DView:
    teeth = gearset.teeth
    held = "differential" if gearset.held == "none" else f"{gearset.held} held"
    enlarged = f"; {axes.text}" if axes else ""
    reach = MILLIMETRES * gearset.transverse.module * (0.5 * teeth.ring + 4.0)
    return rrb.Spatial3DView(
        origin="gears",
        name=f"Gears: {teeth.sun}, {teeth.planet} and {teeth.ring} teeth, {held}{enlarged}",
        background=rrb.Background(color=BACKGROUND),
        line_grid=rrb.LineGrid3D(visible=False),
        eye_controls=rrb.EyeControls3D(
            position=(0.3 * reach, -0.8 * reach, 2.15 * reach),
            look_target=(0.0, -0.04 * reach, 0.0),
            eye_up=(0.0, 1.0, 0.0),
        ),
    )


def _planet(gearset: Gearset) -> rrb.Spatial3DView:
    """The first planet between sun and ring, seen from the carrier."""
    psi = gearset.planet_angles[0]
    outwards = (math.cos(psi), math.sin(psi))
    x, y = (MILLIMETRES * carrier_radius(gearset) * part for part in outwards)
    away = MILLIMETRES * (
        0.5 * gearset.face_width + 1.25 * gearset.transverse.module * gearset.teeth.planet
    )
    return rrb.Spatial3DView(
        origin="gears/carrier",
        contents=["/gears/sun", "/gears/ring", "/gears/carrier/**"],
        name="Planet 1 between sun and ring, seen from the carrier: tooth pairs in contact",
        background=rrb.Background(color=BACKGROUND),
        line_grid=rrb.LineGrid3D(visible=False),
        eye_controls=rrb.EyeControls3D(
            position=(x, y, away), look_target=(x, y, 0.0), eye_up=(*outwards, 0.0)
        ),
    )


def _tabs(
    gearset: Gearset | None,
    compared: str | None,
    axes: Scales | None,
    *,
    followed: bool,
    flanks: Sequence[Shown],
    pages: Sequence[rrb.Container | rrb.View],
) -> rrb.Tabs:
    several, (overview, shown) = compared is not None, OVERVIEW
    difference = [] if compared is None else [_difference(compared)]
    contact = [] if gearset is None else [_contact(gearset)]
    return rrb.Tabs(
        _page(
            "Overview",
            [
                *_wave(overview),
                *(_mesh(name, legend=False) for name in shown),
            ],
            [
                _train("power_loss", several),
                _train("efficiency", several),
                _train("speed", several),
                _set_point("backlash", several),
            ],
        ),
        *(
            _page(title, [*_wave(wave), *map(_mesh, statistics)])
            for title, (wave, statistics) in PAGES.items()
        ),
        *contact,
        *([_flanks(flanks)] if flanks else []),
        *([] if axes is None else [_axes()]),
        _spectra(gearset),
        _page("Power and speed", [_train(name, several) for name in TRAIN_PLOTS]),
        _page("Operating point", [_set_point(name, several) for name in OPERATING_POINT]),
        *difference,
        *([_followed()] if followed else []),
        *pages,
        active_tab=0,
    )


def _contact(gearset: Gearset) -> rrb.Vertical:
    curves = rrb.Horizontal(*map(_zoom, reversed(WAVEFORM_VIEWS)))
    return rrb.Vertical(_planet(gearset), curves, row_shares=[7, 3], name="Tooth contact")


def _flanks(shown: Sequence[Shown]) -> rrb.Vertical:
    """The last tooth pairs at the time cursor, coloured along their path of contact."""
    views = [_chart(f"flanks/{each.field}", each.title, STRIPS_SIZE) for each in shown]
    return rrb.Vertical(*views, name="Flanks")


def _followed() -> rrb.Vertical:
    """A measured gearbox beside its twin, their residuals, and the changes found."""
    beside = [
        _plot(f"{PLACE}/{name}", f"{quantity.heading}: measured and twin", legend=True)
        for name, quantity in PAIRS.items()
    ]
    residuals = [
        _plot(f"{PLACE}/{name}_residual", f"{quantity.heading}: measured minus twin", False)
        for name, quantity in PAIRS.items()
    ]
    alone = [_plot(f"{PLACE}/{name}", title, legend=True) for name, title in ALONE.items()]
    return rrb.Vertical(
        rrb.Horizontal(rrb.Vertical(*beside), rrb.Vertical(*residuals)),
        rrb.Horizontal(*alone),
        rrb.TextLogView(
            origin=EVENTS,
            name="Changes found",
            columns=rrb.TextLogColumns(text_log_columns=["Body"]),
        ),
        row_shares=[6, 2, 1],
        name="Measured beside simulated",
    )


def _axes() -> rrb.Vertical:
    """Load sharing, displacements and bearing forces, and orbits in the housing."""
    orbits = [
        _chart(f"orbit/{member}", f"Orbit of the {member} [µm]", orbit.SIZE) for member in MEMBERS
    ]
    shares = _plot("axes/load_share", SHARING["load_share"].heading, legend=True)
    largest = [_plot(f"axes/{name}", BEARING[name].heading, True) for name in PLOTTED_OF_AXES]
    return rrb.Vertical(
        rrb.Horizontal(*orbits),
        shares,
        rrb.Horizontal(*largest),
        row_shares=[4, 3, 3],
        name="Axes and bearings",
    )


def _spectra(gearset: Gearset | None) -> rrb.Vertical:
    spectrum = _chart(
        "spectrum",
        "Spectrum of the DTE, sun_planet_1, at the time cursor: amplitude [µm]; n×: mesh harmonics",
        spectra.SIZE,
    )
    order_map = _chart(
        "order_map",
        "Order map of the DTE, sun_planet_1: cycles per turn of sun relative to carrier; "
        "n×: mesh harmonics",
        spectra.SIZE,
    )
    portrait = _chart(
        "phase_portrait",
        "Phase portrait, sun_planet_1: rate [mm/s] over DTE [µm]",
        phase_portrait.SIZE,
    )
    return rrb.Vertical(
        spectrum,
        *([] if gearset is None else [order_map]),
        rrb.Horizontal(portrait, _zoom("dte")),
        name="Spectrum",
    )


def _chart(origin: str, title: str, size: tuple[int, int]) -> rrb.Spatial2DView:
    shown = bounds(size)
    return rrb.Spatial2DView(origin=origin, name=title, visual_bounds=shown, background=CHART)


def _page(name: str, *columns: list[rrb.TimeSeriesView]) -> rrb.Horizontal:
    return rrb.Horizontal(*(rrb.Vertical(*views) for views in columns), name=name)


def _mesh(name: str, legend: bool = True) -> rrb.TimeSeriesView:
    return _plot(f"mesh/{name}", MESH[name].heading, legend)


def _train(name: str, several: bool) -> rrb.TimeSeriesView:
    quantity, fields = TRAIN_PLOTS[name]
    return _plot(f"train/{name}", quantity.heading, legend=several or len(fields) > 1)


def _set_point(name: str, several: bool) -> rrb.TimeSeriesView:
    return _plot(f"operating_point/{name}", OPERATING_POINT[name].heading, several)


def _difference(compared: str) -> rrb.Horizontal:
    less = f" minus that of {compared}"
    views = [view for name in WAVEFORM_VIEWS for view in _wave(name, DIFFERENCE, less)]
    return _page("Difference", views)


def _wave(name: str | None, below: str = "", less: str = "") -> list[rrb.TimeSeriesView]:
    """Both views of a quantity of the waveform, if there is one."""
    return [] if name is None else [show(name, below, less) for show in (_zoom, _range)]


def _range(name: str, below: str = "", less: str = "") -> rrb.TimeSeriesView:
    quantity = WAVEFORM[name]
    title = f"{quantity.title}{less}, smallest and largest sample [{quantity.unit}]"
    return _plot(f"{below}/range/{name}", title, legend=False)


def _plot(origin: str, title: str, legend: bool) -> rrb.TimeSeriesView:
    """A plot of everything at `origin`; a single series needs no legend."""
    corner = rrb.PlotLegend(rrb.Corner2D.RightTop, visible=legend)
    return rrb.TimeSeriesView(origin=origin, name=title, plot_legend=corner)


def _zoom(name: str, below: str = "", less: str = "") -> rrb.TimeSeriesView:
    quantity = WAVEFORM[name]
    window = rrb.VisibleTimeRange(
        SIMULATED_TIME,
        start=rrb.TimeRangeBoundary.cursor_relative(nanos=-_ZOOM),
        end=rrb.TimeRangeBoundary.cursor_relative(nanos=_ZOOM),
    )
    return rrb.TimeSeriesView(
        origin=f"{below}/waveform/{name}",
        name=f"{quantity.title}{less} around the time cursor, every sample [{quantity.unit}]",
        plot_legend=rrb.PlotLegend(rrb.Corner2D.RightTop),
        time_ranges=window,
        axis_x=rrb.TimeAxis(link="Independent", view_range=window.range),
    )
