"""What each vein looks like: its line width and its colour."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from vasc.analysis.ancestry import Descent, segment_causes
from vasc.analysis.segment_orders import segment_orders
from vasc.analysis.widths import WidthParameters
from vasc.arrays import NULL, Floats, Ids
from vasc.canals import NO_CANALS, CanalSet
from vasc.errors import VascError
from vasc.network import SegmentKind, VeinNetwork
from vasc.render.differentiation import segment_states, state_key
from vasc.render.styles import (
    AGE_COLORS,
    COLOR_CHOICES,
    KIND_COLORS,
    ORDER_COLORS,
    SOURCE_COLORS,
    STATE_COLORS,
    Key,
    LeafStyle,
)

AGE_CLASSES = 64


@dataclass(frozen=True)
class Scale:
    """How large a picture is and how dense its veins are.

    Parameters
    ----------
    points_per_length : float
        Scale of the drawing, pt per D.
    picture_side : float
        Longer side of the picture, in pt.
    spacing : float
        Mean distance between veins, in D.
    """

    points_per_length: float
    picture_side: float
    spacing: float


@dataclass(frozen=True)
class Paint:
    """What the colours of a picture are to tell.

    Parameters
    ----------
    color : {"width", "order", "age", "source", "kind", "state"}
        Nothing beyond the width; the vein order (see
        :func:`vasc.analysis.vein_orders`); the step of birth; the source that
        caused the vein; extension, join or refinement; differentiation.
    style : LeafStyle
        The colour of plain veins.
    last_step : int
        The step that the colour of the youngest veins stands for.
    canals : CanalSet
        The canals, whose states tell those of the strands.
    """

    color: str
    style: LeafStyle
    last_step: int
    canals: CanalSet = NO_CANALS


@dataclass(frozen=True)
class Coloring:
    """A colour for every segment.

    Parameters
    ----------
    classes : ndarray of shape (m,), int64
        Row of ``palette`` for every segment.
    palette : tuple of str
        Colours.
    key : Key
        What they mean.
    """

    classes: NDArray[np.int64]
    palette: tuple[str, ...]
    key: Key


def fit_widths(
    most: float, parameters: WidthParameters, style: LeafStyle, scale: Scale
) -> WidthParameters:
    """Settle the radii that were left open, so that the widths suit a picture.

    Parameters
    ----------
    most : float
        The most veinlets that any node of the network serves.
    parameters : WidthParameters
        A radius given there is kept: veins are then drawn to scale.
    style : LeafStyle
        Limits for what is left open.
    scale : Scale
        Size of the picture.

    Returns
    -------
    WidthParameters
        With ``tip_radius`` and ``exponent`` for all veins, in this picture and
        in others of the same run.
    """
    low, high = style.finest
    finest = min(max(style.finest_share * scale.spacing * scale.points_per_length, low), high)
    tip = parameters.tip_radius or finest / 2.0 / scale.points_per_length
    exponent = parameters.exponent
    base = parameters.base_radius
    if base is None and parameters.tip_radius is None:
        thickest = style.thickest_share * scale.picture_side / 2.0 / scale.points_per_length
        base = min(tip * most ** (1.0 / exponent), max(thickest, tip))
    if base is not None and most > 1.0:
        # N veinlets make a vein of r0 N^(1/n): the n that makes the base as thick as asked
        exponent = math.log(most) / max(math.log(base / tip), 1e-9)
    return parameters.model_copy(
        update={"tip_radius": tip, "base_radius": None, "exponent": exponent}
    )


def width_classes(widths: Floats, n_classes: int) -> tuple[NDArray[np.int64], Floats]:
    """Group widths into classes of one ratio.

    Parameters
    ----------
    widths : ndarray of shape (m,), float64
        Line widths, above 0.
    n_classes : int
        Classes at most.

    Returns
    -------
    classes : ndarray of shape (m,), int64
        0 for the finest.
    class_widths : ndarray of shape (n_classes,), float64
        The width of each class, rising from the finest to the thickest.
    """
    low, high = float(widths.min(initial=np.inf)), float(widths.max(initial=0.0))
    if len(widths) == 0 or high <= low:
        return np.zeros(len(widths), dtype=np.int64), np.array([high])
    class_widths = np.geomspace(low, high, n_classes)
    places = np.log(widths / low) / np.log(high / low) * (n_classes - 1)
    return np.rint(places).astype(np.int64), class_widths


def color_segments(
    network: VeinNetwork, paint: Paint, directions: Descent, widths: Floats
) -> Coloring:
    """Choose a colour for every segment.

    Parameters
    ----------
    network : VeinNetwork
        The veins.
    paint : Paint
        What colours are to tell.
    directions : Descent
        The network's descent.
    widths : ndarray of shape (m,), float64
        Widths of the segments by the rule of the run, which tell vein orders.

    Returns
    -------
    Coloring

    Raises
    ------
    VascError
        If ``paint.color`` is none of the choices.
    """
    color, style = paint.color, paint.style
    if color == "width":
        plain = np.zeros(network.n_segments, dtype=np.int64)
        return Coloring(plain, (style.vein,), Key())
    if color == "order":
        return _by_order(segment_orders(network, widths))
    if color == "age":
        return _by_age(network, paint.last_step)
    if color == "source":
        causes = segment_causes(network, directions).astype(np.int64)
        palette = (*SOURCE_COLORS, style.vein)
        classes = np.where(causes == NULL, len(SOURCE_COLORS), causes % len(SOURCE_COLORS))
        return Coloring(classes, palette, _key_of_sources(classes, palette))
    if color == "kind":
        names = tuple(kind.name.lower() for kind in SegmentKind)
        colors = tuple(KIND_COLORS[name] for name in names)
        shown = [int(kind) for kind in SegmentKind if (network.segment_kinds == kind).any()]
        key = Key("segment", tuple(names[k] for k in shown), tuple(colors[k] for k in shown))
        return Coloring(network.segment_kinds.astype(np.int64), colors, key)
    if color == "state":
        states = segment_states(paint.canals, directions)
        return Coloring(states, tuple(STATE_COLORS.values()), state_key(paint.canals))
    raise VascError(f"color: {color!r} is not one of {', '.join(COLOR_CHOICES)}")


def _key_of_sources(classes: NDArray[np.int64], palette: tuple[str, ...]) -> Key:
    """Say which colour is of which sources: colours are as many as digits."""
    shown = np.unique(classes).tolist()
    labels = tuple("none" if row == len(SOURCE_COLORS) else str(row) for row in shown)
    return Key("source ends in", labels, tuple(palette[row] for row in shown))


def _by_order(orders: Ids) -> Coloring:
    """Colour by vein order, all orders from the last colour on alike."""
    n_colors = len(ORDER_COLORS)
    n_shown = min(int(orders.max(initial=1)), n_colors)
    labels = [str(order) for order in range(1, n_shown + 1)]
    if n_shown == n_colors:
        labels[-1] += "+"
    key = Key("vein order", tuple(labels), ORDER_COLORS[:n_shown])
    return Coloring(np.minimum(orders, n_colors).astype(np.int64) - 1, ORDER_COLORS, key)


def _by_age(network: VeinNetwork, last_step: int) -> Coloring:
    """Colour by the step at which each vein grew, from step 0 on."""
    births = network.vein_births / max(last_step, 1)
    classes = np.rint(np.clip(births, 0.0, 1.0) * (AGE_CLASSES - 1)).astype(np.int64)
    key = Key("step of birth", ("0", str(last_step)), AGE_COLORS, is_gradient=True)
    return Coloring(classes, gradient(AGE_COLORS, AGE_CLASSES), key)


def gradient(colors: tuple[str, ...], n_colors: int) -> tuple[str, ...]:
    """Give ``n_colors`` colours that run evenly through the given ones."""
    stops = np.array([[int(color[i : i + 2], 16) for i in (1, 3, 5)] for color in colors])
    places = np.linspace(0.0, len(colors) - 1.0, n_colors)
    mixed = np.stack(
        [np.interp(places, np.arange(len(colors)), channel) for channel in stops.T], axis=1
    )
    return tuple("#{:02x}{:02x}{:02x}".format(*row) for row in np.rint(mixed).astype(int).tolist())
