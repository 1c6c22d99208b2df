"""How a leaf is drawn: colours, line widths and sizes, with their reasons."""

from dataclasses import dataclass
from enum import Enum
from typing import Literal, get_args

ColorBy = Literal["width", "order", "age", "source", "kind", "state"]
COLOR_CHOICES: tuple[str, ...] = get_args(ColorBy)
TissueColorBy = Literal["concentration", "flux", "carriers", "role"]
TISSUE_COLOR_CHOICES: tuple[str, ...] = get_args(TissueColorBy)

DPI = 200
"""Pixels per inch of pictures in pixels; a line of 1 pt is then 2.8 pixels wide."""

TEXT_SIZE = 8.0
"""Size of the few words in a picture, in pt."""
CORNER = 5.0
"""Distance of scale bar and key from the edge of the picture, in pt."""
STRIP = 20.0
"""Height kept free of leaf for them, in pt."""
INK = "#303030"

ORDER_COLORS = ("#7a1c1c", "#c0561f", "#c99a1e", "#4f8a3c", "#2c7f86", "#3d55a1", "#7a4a94")
"""Orders 1 ... 6, and one colour for all higher ones."""

SOURCE_COLORS = (
    "#4e79a7",
    "#f28e2b",
    "#59a14f",
    "#e15759",
    "#76b7b2",
    "#b07aa1",
    "#9c755f",
    "#d4a72c",
    "#d37295",
    "#5f6b6d",
)
"""Colours that veins take in turn by the number of the source that caused them."""

KIND_COLORS = {"extension": "#23401f", "join": "#c8102e", "refinement": "#5c8a54"}
STATE_COLORS = {
    "vein": "#23401f",
    "inbound": "#e07b00",
    "outbound": "#2166ac",
    "pre-pattern": "#8e44ad",
    "arrested": "#23401f",
}
SOURCE_STATE_COLORS = {"active": "#c8102e", "tagged": "#f08a24"}
AGE_COLORS = ("#16215b", "#5a2a82", "#a02c74", "#d64a4b", "#ef8a1d")
"""From the oldest vein to the youngest."""


class Mark(Enum):
    """How a key shows what it explains."""

    SQUARE = "square"
    DASH = "dash"
    DISC = "disc"
    RING = "ring"


@dataclass(frozen=True)
class Key:
    """What the colours of a picture mean.

    Parameters
    ----------
    title : str
        What is coloured; empty if there is nothing to explain.
    labels : tuple of str
        Meanings, one for every colour; for a gradient its first and last.
    colors : tuple of str
        Colours in the same order.
    is_gradient : bool
        Whether the colours run into each other.
    marks : tuple of Mark
        What is drawn before every label; squares if left out.
    """

    title: str = ""
    labels: tuple[str, ...] = ()
    colors: tuple[str, ...] = ()
    is_gradient: bool = False
    marks: tuple[Mark, ...] = ()


@dataclass(frozen=True)
class LeafStyle:
    """Colours and measures of a picture of a leaf.

    Line widths follow Murray's law and are fitted to the picture: the finest
    vein takes a share of the mean distance between veins, within what an eye
    can see; the thickest is held to a share of the picture by a larger exponent
    (see :class:`vasc.analysis.WidthParameters`), so that the order of widths is kept.

    Parameters
    ----------
    blade, margin, vein, background : str
        Colours of the blade, its outline, the veins and the paper.
    margin_width : float
        Width of the outline, in pt.
    finest : tuple of float
        Smallest and largest width of the finest veins, in pt.
    finest_share : float
        Width of the finest veins over the mean distance between veins.
    thickest_share : float
        Largest width of the thickest vein over the longer side of the picture.
    n_classes : int
        Different line widths; neighbours then differ by less than an eye sees.
    source_size : float
        Diameter of a source, in pt.
    padding : float
        Free paper around the blade over its longer side.
    """

    blade: str = "#dcebd0"
    margin: str = "#6f9463"
    vein: str = "#1f3d1c"
    background: str = "#ffffff"
    margin_width: float = 0.6
    finest: tuple[float, float] = (0.3, 1.1)
    finest_share: float = 0.13
    thickest_share: float = 0.014
    n_classes: int = 48
    source_size: float = 2.6
    padding: float = 0.02
