"""A stem unrolled as in idealized diagrams: split along a line and laid flat."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from vasc.analysis.ways import ways
from vasc.arrays import Floats, Ids, Points
from vasc.errors import ShapeError
from vasc.render.keys import size_in_points
from vasc.render.saving import save
from vasc.render.styles import INK, TEXT_SIZE

if TYPE_CHECKING:
    from matplotlib.artist import Artist
    from matplotlib.axes import Axes

TURN = 360.0
"""A full turn, in degrees."""
ASIDE = np.array([TURN, 0.0])
"""From a place to the same one a turn on."""
DASHES = (0.0, (3.0, 2.0))
"""Dashes of what is beyond the cut, in widths of its lines."""
BORDER = 6.0
"""No box is drawn nearer to the edge of the picture, in degrees."""
BOX_SIDES = (2.0, 1.7)
"""Width and height of a box, over the size of its number; for two digits."""
COVERED = 0.5
"""Boxes that hide more than this share of a vein straight up to the next one stand beside it."""
ASIDE_BY = 3.5
"""How far beside, in pt."""


@dataclass(frozen=True)
class UnrolledStyle:
    """Colours and measures of an unrolled stem.

    Parameters
    ----------
    vein, faded, severed : str
        Colours of veins, of those near the axis, where unrolling means little, and of
        what goes on beyond the cut.
    box : str
        Colour inside the boxes of primordia.
    near_axis : float
        Veins nearer to the axis than this share of the radius are faded.
    strip : float
        Width of what is drawn beyond the cut on either side, in degrees.
    widths : tuple of float
        Widths of veins at the base and at the top, in pt; linear in between.
    width : float
        Width of the picture, in inches.
    proportions : tuple of float
        Least and largest height of the stem over the width of a full turn; a stem
        between them is drawn to scale.
    text : tuple of float
        Least and largest size of the numbers of primordia, in pt.
    """

    vein: str = "#1f3d1c"
    faded: str = "#c3d1bf"
    severed: str = "#7f9a7a"
    box: str = "#f4f1d8"
    near_axis: float = 0.2
    strip: float = 42.0
    widths: tuple[float, float] = (1.6, 0.8)
    width: float = 7.0
    proportions: tuple[float, float] = (0.55, 1.4)
    text: tuple[float, float] = (4.5, 7.5)


@dataclass(frozen=True)
class Unrolled:
    """A stem laid flat.

    Parameters
    ----------
    places : ndarray of shape (n, 2), float64
        Angle from the cut, in degrees from 0 to 360, and height in D, of each node.
    reach : ndarray of shape (m,), float64
        Angle from the first to the second end of each segment the short way round.
    is_severed : ndarray of shape (m,), bool
        Segments that the cut goes through.
    is_faded : ndarray of shape (m,), bool
        Segments near the axis.
    """

    places: Points
    reach: Floats
    is_severed: NDArray[np.bool_]
    is_faded: NDArray[np.bool_]


def unroll(
    positions: Points,
    segments: Ids,
    radius: float | Floats,
    *,
    cut: float = 0.0,
    near_axis: float = 0.2,
) -> Unrolled:
    """Split a stem along a line and lay it flat.

    Parameters
    ----------
    positions : ndarray of shape (n, 3), float64
        Vein nodes, in D; the stem stands along the third axis, around the origin.
    segments : ndarray of shape (m, 2), integer
        Node ids.
    radius : float or ndarray of shape (n,)
        Of the stem, in D; one of every node where it changes with the height.
    cut : float
        Angle of the line that it is split along, in rad.
    near_axis : float
        Share of the radius within which a segment is near the axis.

    Returns
    -------
    Unrolled

    Notes
    -----
    Runions (2008), equation 6.3, with the quadrant of the angle kept.

    Examples
    --------
    >>> sides = np.array([[1.0, 0.1, 0.0], [1.0, -0.1, 0.0], [-1.0, 0.0, 2.0]])
    >>> flat = unroll(sides, np.array([[0, 1], [1, 2]]), 1.0)
    >>> flat.places.round(1).tolist()
    [[5.7, 0.0], [354.3, 0.0], [180.0, 2.0]]
    >>> flat.is_severed.tolist()
    [True, False]
    """
    x, y, height = positions.T
    angles = np.degrees(np.arctan2(y, x) - cut) % TURN
    places = np.stack([angles, height], axis=1)
    across = angles[segments[:, 1]] - angles[segments[:, 0]]
    reach = TURN / 2.0 - (TURN / 2.0 - across) % TURN
    # where the segment passes nearest to the axis is at one of its ends, or nearly
    distances = (np.hypot(x, y) / radius)[segments].min(axis=1, initial=np.inf)
    return Unrolled(places, reach, np.abs(across) > TURN / 2.0, distances < near_axis)


def draw_unrolled(
    positions: Points,
    segments: Ids,
    primordia: Ids,
    output: str | Path,
    *,
    radius: float | Floats,
    cut: float = 0.0,
    title: str = "",
    style: UnrolledStyle | None = None,
) -> Path:
    """Write a picture of a stem that is split along a line and laid flat.

    Primordia are numbered boxes, in the order of birth. Connections that the cut goes
    through go on, dashed, beyond it on both sides. Veins near the axis are pale: they
    are connected as drawn, but are not where they seem to be.

    Parameters
    ----------
    positions : ndarray of shape (n, 3), float64
        Vein nodes, in D; the stem stands along the third axis, around the origin.
    segments : ndarray of shape (m, 2), integer
        Node ids.
    primordia : ndarray of shape (p,), integer
        Node ids, in the order of birth.
    output : path
        The picture; png, svg or pdf by its suffix. An old one is replaced.
    radius : float or ndarray of shape (n,)
        Of the stem, in D; one of every node where it changes with the height.
    cut : float
        Angle of the line that it is split along, in rad.
    title : str
        Written above.
    style : UnrolledStyle, optional
        Colours and measures.

    Returns
    -------
    Path
        The file written.

    Raises
    ------
    ShapeError
        If ``positions`` has another shape.
    OutputError
        If the suffix is none of these, or the folder does not exist.
    """
    from matplotlib.figure import Figure

    if positions.ndim != 2 or positions.shape[1] != 3:
        raise ShapeError(f"positions: expected shape (n, 3), got {positions.shape}")
    style = UnrolledStyle() if style is None else style
    top = float(positions[:, 2].max(initial=1.0))
    turn_width = style.width * TURN / (TURN + 2.0 * style.strip + 40.0)
    to_scale = top / (2.0 * np.pi * float(np.max(radius, initial=1e-9)))
    height = turn_width * float(np.clip(to_scale, *style.proportions))
    figure = Figure(figsize=(style.width, height + 0.9))
    axes = figure.add_axes((0.09, 0.5 / (height + 0.9), 0.9, height / (height + 0.9)))
    draw_flat(axes, positions, segments, primordia, radius=radius, cut=cut, style=style)
    _finish(axes, title)
    save(figure, output)
    return Path(output)


def draw_flat(
    axes: Axes,
    positions: Points,
    segments: Ids,
    primordia: Ids,
    *,
    radius: float | Floats,
    cut: float = 0.0,
    style: UnrolledStyle | None = None,
) -> None:
    """Draw a stem that is split along a line and laid flat, with nothing around it.

    Parameters
    ----------
    axes : matplotlib Axes
        Where to draw; its size must be final.
    positions, segments, primordia, radius, cut, style
        See :func:`draw_unrolled`.
    """
    style = UnrolledStyle() if style is None else style
    flat = unroll(positions, segments, radius, cut=cut, near_axis=style.near_axis)
    top = float(positions[:, 2].max(initial=1.0))
    axes.set_xlim(-style.strip, TURN + style.strip)
    axes.set_ylim(-0.02 * top, 1.04 * top)
    _draw_veins(axes, flat, segments, style, top)
    beyond = _beyond(flat, segments, primordia, len(positions))
    _draw_beyond(axes, flat, segments[beyond], style)
    continued = np.isin(primordia, segments[beyond])
    width, height = size_in_points(axes)
    area = width * TURN / (TURN + 2.0 * style.strip) * height / max(len(primordia), 1)
    size = float(np.clip(0.3 * np.sqrt(area), *style.text))
    shares = size / np.array([width, height]) * [TURN + 2.0 * style.strip, 1.06 * top]
    aside = _hides_veins(flat.places[primordia], shares * BOX_SIDES)
    _draw_boxes(axes, flat.places[primordia], continued, style, size, aside=aside)


def _draw_veins(
    axes: Axes, flat: Unrolled, segments: Ids, style: UnrolledStyle, top: float
) -> None:
    """Draw the veins between the two sides of the cut, thinner towards the top."""
    from matplotlib.collections import LineCollection

    starts = flat.places[segments[:, 0]]
    ends = np.stack([starts[:, 0] + flat.reach, flat.places[segments[:, 1], 1]], axis=1)
    lines = np.stack([starts, ends], axis=1)
    # what the cut goes through is seen from both sides
    other = lines[flat.is_severed] - np.sign(flat.reach[flat.is_severed])[:, None, None] * ASIDE
    lines = np.concatenate([lines, other])
    is_faded = np.concatenate([flat.is_faded, flat.is_faded[flat.is_severed]])
    base, tip = style.widths
    widths = base + (tip - base) * np.clip(lines[:, :, 1].mean(axis=1) / top, 0.0, 1.0)
    for order, (rows, color) in enumerate(((is_faded, style.faded), (~is_faded, style.vein))):
        drawn = axes.add_collection(
            LineCollection(
                list(lines[rows]),
                colors=color,
                linewidths=widths[rows],
                capstyle="round",
                zorder=1 + order,
            )
        )
        _clip(axes, drawn, 0.0, TURN)


def _clip(axes: Axes, drawn: Artist, left: float, right: float) -> None:
    """Draw a thing between two angles only."""
    from matplotlib.patches import Rectangle

    bottom, top = axes.get_ylim()
    frame = Rectangle((left, bottom), right - left, top - bottom, transform=axes.transData)
    drawn.set_clip_path(frame)


def _beyond(flat: Unrolled, segments: Ids, primordia: Ids, n_nodes: int) -> NDArray[np.intp]:
    """Give the segments of connections between primordia that the cut goes through."""
    from scipy.sparse import csr_array
    from scipy.sparse.csgraph import connected_components

    is_level = np.ptp(flat.places[segments, 1], axis=1) < 1e-9
    # the ring at the base goes round without an end; near the axis angles mean nothing
    is_vein = ~(is_level & (flat.places[segments[:, 0], 1] < 1e-9)) & ~flat.is_faded
    ends = np.isin(segments, primordia)
    inner = segments[is_vein & ~ends.any(axis=1)]
    links = csr_array((np.ones(len(inner)), (inner[:, 0], inner[:, 1])), (n_nodes, n_nodes))
    parts = connected_components(links, directed=False)[1]
    # the part of a segment that ends at a primordium is that of its other end
    part = np.where(ends[:, 0], parts[segments[:, 1]], parts[segments[:, 0]])
    is_cut = np.isin(part, part[flat.is_severed & is_vein])
    return np.flatnonzero(is_vein & is_cut)


def _draw_beyond(axes: Axes, flat: Unrolled, segments: Ids, style: UnrolledStyle) -> None:
    """Draw severed connections beyond both sides of the cut."""
    from matplotlib.collections import LineCollection

    for side, left in ((-1.0, -style.strip), (1.0, TURN)):
        # beyond the left side is what the right half holds, and the other way round
        places = flat.places.copy()
        places[(places[:, 0] - TURN / 2.0) * side < 0.0, 0] += side * TURN
        across = np.ptp(places[segments, 0], axis=1)
        lines = [places[way] for way in ways(segments[across < TURN / 2.0])]
        drawn = axes.add_collection(
            LineCollection(
                lines, colors=style.severed, linewidths=style.widths[1], linestyles=DASHES
            )
        )
        _clip(axes, drawn, left, left + style.strip)


def _hides_veins(places: Points, box: Floats) -> bool:
    """Tell whether most boxes would cover the way to the next primordium straight above."""
    off = places[None, :] - places[:, None]
    across = np.abs((off[:, :, 0] + TURN / 2.0) % TURN - TURN / 2.0)
    rises = np.where((across < box[0]) & (off[:, :, 1] > 0.0), off[:, :, 1], np.inf)
    nearest = rises.min(axis=1, initial=np.inf)
    return 2 * int((nearest * COVERED < box[1]).sum()) > len(places)


def _draw_boxes(
    axes: Axes,
    places: Points,
    continued: NDArray[np.bool_],
    style: UnrolledStyle,
    size: float,
    *,
    aside: bool,
) -> None:
    """Draw primordia as numbered boxes, dashed where a connection ends beyond the cut.

    Boxes that stand aside leave a point at the place of the primordium.
    """
    for number, ((angle, height), is_continued) in enumerate(zip(places, continued, strict=True)):
        beyond = [angle - TURN, angle + TURN] if is_continued else []
        for at in [angle, *beyond]:
            is_own = at == angle
            if not -style.strip + BORDER < at < TURN + style.strip - BORDER:
                continue
            color = INK if is_own else style.severed
            order = 4 if is_own else 3
            if aside:
                axes.plot(at, height, "o", color=color, markersize=2.5, zorder=order)
            axes.annotate(
                str(number),
                (at, height),
                xytext=(ASIDE_BY if aside else 0.0, 0.0),
                textcoords="offset points",
                size=size,
                color=color,
                ha="left" if aside else "center",
                va="center",
                zorder=order,
                bbox={
                    "boxstyle": "square,pad=0.22",
                    "facecolor": style.box if is_own else "white",
                    "edgecolor": color,
                    "linewidth": 0.6,
                    "linestyle": "-" if is_own else (0, (2.0, 1.5)),
                },
            )


def _finish(axes: Axes, title: str) -> None:
    """Write the axes and the title, and mark the cut."""
    for angle in (0.0, TURN):
        axes.axvline(angle, color=INK, linewidth=0.5, linestyle=(0, (1.0, 2.0)), zorder=0)
    axes.set_xticks(np.arange(0.0, TURN + 1.0, 90.0))
    axes.set_xlabel("angle from the cut, in degrees", size=TEXT_SIZE, color=INK)
    axes.set_ylabel("height, in D", size=TEXT_SIZE, color=INK)
    axes.tick_params(labelsize=TEXT_SIZE, colors=INK, width=0.5, length=2.5)
    for side, spine in axes.spines.items():
        spine.set_visible(side == "left")
        spine.set_linewidth(0.5)
    if title:
        axes.set_title(title, size=TEXT_SIZE + 1.0, color=INK)
