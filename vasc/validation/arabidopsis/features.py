"""Features of the wild-type first leaf, measured at the last step, and its mirror symmetry."""

from itertools import pairwise
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vasc.arrays import Ids, Points
from vasc.events import EventKind
from vasc.timeline import Frame, Timeline
from vasc.validation.arabidopsis.cast import Cast
from vasc.validation.arabidopsis.story import MIDVEIN, LoopStory
from vasc.validation.arabidopsis.verdicts import Verdict, judged, undecided
from vasc.validation.references import N_LOOP_PAIRS, SEQUENCE

if TYPE_CHECKING:
    from shapely import Polygon

MEASURES = {
    "a": "the midvein's nodes span at least {span:.0%} of the leaf, and the straight distance"
    " between its ends is at least {straight:.0%} of its whole length",
    "b": "loop pairs, of {pairs}, closed on both sides with the midvein and an older vein",
    "c": "of the sources after the lateral pairs that were drained, the share whose veins neither"
    " joined another nor ended freely is at most {unfinished:.0%}",
    "d": "between successive loops of a side the network's outline, against its convex hull, is"
    " notched by at least {notch:.0%} of the leaf length",
}
"""How each feature is measured; the numbers in it are ours."""


def measure_texts() -> dict[str, str]:
    """Give the measures of the features in words, with their numbers."""
    numbers = {
        "span": SEQUENCE.midvein_span,
        "straight": SEQUENCE.midvein_straightness,
        "pairs": N_LOOP_PAIRS,
        "unfinished": SEQUENCE.unfinished_share,
        "notch": SEQUENCE.notch_depth,
    }
    return {name: text.format(**numbers) for name, text in MEASURES.items()}


def measure_features(timeline: Timeline, cast: Cast, owners: Ids) -> dict[str, Verdict]:
    """Measure features (a) to (d) of Verna et al. (2019) at the last step.

    Parameters
    ----------
    timeline : Timeline
        The run.
    cast : Cast
        Who is who in it.
    owners : ndarray of shape (n,), int32
        Owner of every node.
    """
    frame = timeline.frame()
    return {
        "a": _midvein(frame, owners),
        "b": _closed_loops(cast),
        "c": _minor_veins(timeline, cast),
        "d": _scallops(cast, frame.blade.length),
    }


def _midvein(frame: Frame, owners: Ids) -> Verdict:
    """Measure (a): how far the midvein runs, and how straight."""
    network = frame.network
    # the seed is the lower end of the midvein
    is_midvein = owners[: network.n_nodes] <= MIDVEIN
    inside = is_midvein[network.segments].all(axis=1)
    if not inside.any():
        return undecided("there is no midvein")
    places = network.positions[np.unique(network.segments[inside])]
    low, high = places[np.argmin(places[:, 1])], places[np.argmax(places[:, 1])]
    span = float(high[1] - low[1]) / frame.blade.length
    straightness = float(np.hypot(*(high - low))) / float(network.lengths[inside].sum())
    passed = span >= SEQUENCE.midvein_span and straightness >= SEQUENCE.midvein_straightness
    value = f"spans {span:.2f} of the leaf, straightness {straightness:.2f}"
    return judged(passed, value, "it is not one straight line along the leaf")


def n_loop_pairs(cast: Cast) -> int:
    """Count the loop pairs of the observed sequence that are closed on both sides."""
    return sum(loops is not None for loops in (cast.loop_1, cast.loop_2, cast.loop_3))


def _closed_loops(cast: Cast) -> Verdict:
    """Measure (b): the loops that lateral veins close."""
    closed = n_loop_pairs(cast)
    if closed < N_LOOP_PAIRS and not cast.story.is_over:
        return Verdict(None, closed, "the run is not over")
    return judged(closed >= N_LOOP_PAIRS, closed, f"{closed} of {N_LOOP_PAIRS}")


def _minor_veins(timeline: Timeline, cast: Cast) -> Verdict:
    """Measure (c): how the veins of later sources ended."""
    actors = {cast.story.sources[0].id}
    for pair in (cast.pair_1, cast.upper, cast.pair_2, cast.pair_3):
        actors |= set() if pair is None else pair.ids
    minor = {
        one.id
        for one in cast.story.sources
        if one.id not in actors and one.drained_step is not None
    }
    if not minor:
        return undecided("there are no minor veins")
    events = timeline.events
    ends = {
        kind: minor & set(events["object"][events["kind"] == kind].tolist())
        for kind in (EventKind.VEIN_JOINED, EventKind.VEIN_ENDED_BLINDLY)
    }
    joined, free = ends.values()
    unfinished = len(minor - joined - free)
    value = f"{len(minor)} minor veins: {len(joined)} join, {len(free)} end freely"
    share = unfinished / len(minor)
    if share > SEQUENCE.unfinished_share and not cast.story.is_over:
        return Verdict(None, value, "the run is not over")
    return judged(share <= SEQUENCE.unfinished_share, value, f"{unfinished} do neither")


def _scallops(cast: Cast, leaf_length: float) -> Verdict:
    """Measure (d): the shallowest notch between successive loops of a side."""
    pairs = [loops for loops in (cast.loop_1, cast.loop_2, cast.loop_3) if loops is not None]
    if len(pairs) < 2:
        return undecided("there are no successive loops")
    depths = []
    for side in (0, 1):
        loops = [pair.sides[side] for pair in pairs]
        depths += notch_depths(loops, closing=SEQUENCE.notch_depth * leaf_length / 2.0)
    depth = min(depths) / leaf_length
    return judged(depth >= SEQUENCE.notch_depth, round(depth, 4), f"the shallowest is {depth:.3f}")


def notch_depths(loops: list[LoopStory], closing: float) -> list[float]:
    """Give the depth of the notch between each loop and the next, in D; 0 without one.

    Parameters
    ----------
    loops : list of LoopStory
        Of one side, from the tip to the base.
    closing : float
        Gaps narrower than twice this are no notch: neighbors share a vein, but
        their polygons were frozen at different times.
    """
    import shapely

    pieces = [shapely.make_valid(shapely.Polygon(loop.outline)) for loop in loops]
    whole = shapely.union_all([piece.buffer(closing) for piece in pieces]).buffer(-closing)
    hull = whole.convex_hull
    parts = shapely.get_parts(hull.difference(whole))
    pockets = [part for part in parts if part.distance(hull.exterior) <= closing]
    return [
        max(
            (
                _depth(pocket, hull.exterior)
                for pocket in pockets
                if max(pocket.distance(piece) for piece in both) <= 2.0 * closing
            ),
            default=0.0,
        )
        for both in pairwise(pieces)
    ]


def _depth(pocket: "Polygon", edge: "Polygon") -> float:
    """Give how far a pocket reaches in from the edge of the hull."""
    import shapely

    corners = shapely.points(shapely.get_coordinates(pocket))
    return float(shapely.distance(corners, edge).max())


class Symmetry(NamedTuple):
    """Largest distances between a set of points and its mirror image about the axis, in D.

    Parameters
    ----------
    nodes : float
        Of the vein nodes at the last step, retired ones left out.
    sources : float
        Of the live sources.
    """

    nodes: float
    sources: float

    @property
    def largest(self) -> float:
        """The larger of the two; exactly 0 for an exactly mirrored leaf."""
        return max(self)


def measure_symmetry(frame: Frame) -> Symmetry:
    """Measure how far a leaf is from its mirror image.

    Parameters
    ----------
    frame : Frame
        A recorded step.
    """
    network = frame.network
    return Symmetry(
        mirror_distance(network.positions[network.degrees > 0]),
        mirror_distance(frame.sources.positions),
    )


def mirror_distance(points: Points) -> float:
    """Give the largest distance from a point to the mirror image of a set; 0 for none.

    Examples
    --------
    >>> mirror_distance(np.array([[-1.0, 2.0], [1.0, 2.0], [0.0, 3.0]]))
    0.0
    >>> mirror_distance(np.array([[-1.0, 2.0], [1.0, 2.5]]))
    0.5
    """
    if len(points) == 0:
        return 0.0
    from scipy.spatial import KDTree

    mirrored: NDArray[np.float64] = points * np.array([-1.0, 1.0])
    distances, _ = KDTree(mirrored).query(points)
    return float(distances.max())
