"""Veins cut into sections: from one junction or free end to the next."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from vasc import kernels
from vasc.analysis.faces import planar_drawing
from vasc.arrays import Floats, Points
from vasc.faces import Drawing
from vasc.network import Origin, VeinNetwork

SHORT = 0.4
"""Of the mean length of sections: what is shorter has no certain direction."""


@dataclass(frozen=True)
class Sections:
    """The veins of a network as they are drawn, cut at junctions, free ends and seeds.

    Parameters
    ----------
    drawing : Drawing
        Points and segments, cut where they cross.
    segment_lengths, segment_widths : ndarray of shape (q,), float64
        Of each segment of the drawing, lengths along its course.
    walked : ndarray of shape (q,), int64
        Half-edges of the segments, section by section (see
        :mod:`vasc.kernels.sections`).
    begins : ndarray of shape (k + 1,), int64
        Where each section begins among them, with q at the end.
    seeds : ndarray of shape (s,), int64
        Rows of the points that are seeds; empty where that is not known.
    """

    drawing: Drawing
    segment_lengths: Floats
    segment_widths: Floats
    walked: NDArray[np.int64]
    begins: NDArray[np.int64]
    seeds: NDArray[np.int64]

    @property
    def n_sections(self) -> int:
        """Number of sections."""
        return len(self.begins) - 1

    @cached_property
    def rows(self) -> NDArray[np.int64]:
        """Rows of the segments in the order walked, shape (q,)."""
        return self.walked % max(len(self.drawing.segments), 1)

    @cached_property
    def owners(self) -> NDArray[np.int64]:
        """The section of each segment in the order walked, shape (q,)."""
        return np.repeat(np.arange(self.n_sections), np.diff(self.begins))

    @cached_property
    def points_walked(self) -> NDArray[np.int64]:
        """Rows of the point each half-edge walked begins and ends at, shape (q, 2)."""
        segments = self.drawing.segments[self.rows].astype(np.int64)
        is_back = self.walked >= len(segments)
        return np.where(is_back[:, None], segments[:, ::-1], segments)

    @cached_property
    def ends(self) -> NDArray[np.int64]:
        """Rows of the first and last point of each section, shape (k, 2)."""
        first, last = self.begins[:-1], self.begins[1:] - 1
        return np.stack([self.points_walked[first, 0], self.points_walked[last, 1]], axis=1)

    @cached_property
    def lengths(self) -> Floats:
        """Lengths along the course of each section, shape (k,)."""
        return self.sums(self.segment_lengths[self.rows])

    @cached_property
    def widths(self) -> Floats:
        """Mean width of each section along its length, shape (k,)."""
        lengths = self.segment_lengths[self.rows]
        return self.sums(lengths * self.segment_widths[self.rows]) / self.lengths

    @cached_property
    def end_widths(self) -> Floats:
        """Width at the first and at the last point of each section, shape (k, 2)."""
        first, last = self.rows[self.begins[:-1]], self.rows[self.begins[1:] - 1]
        return np.stack([self.segment_widths[first], self.segment_widths[last]], axis=1)

    @cached_property
    def degrees(self) -> NDArray[np.int64]:
        """Section ends that meet at each point of the drawing, shape (p,)."""
        return np.bincount(self.ends.ravel(), minlength=len(self.drawing.points))

    @cached_property
    def spans(self) -> Floats:
        """Lengths of the sections as they are drawn, shape (k,)."""
        steps = np.diff(self.drawing.points[self.points_walked], axis=1)[:, 0]
        return self.sums(np.sqrt((steps**2).sum(axis=1)))

    @cached_property
    def reach(self) -> float:
        """How far from a junction the direction of a section is taken; 0 without any."""
        return SHORT * float(self.lengths.mean()) if self.n_sections else 0.0

    @cached_property
    def is_looped(self) -> NDArray[np.bool_]:
        """False for sections of trees that end freely, shape (k,): cut off end by end."""
        is_left = np.ones(self.n_sections, dtype=bool)
        while True:
            degrees = np.bincount(self.ends[is_left].ravel(), minlength=len(self.drawing.points))
            is_kept = is_left & (degrees[self.ends] > 1).all(axis=1)
            if np.array_equal(is_kept, is_left):
                return is_kept
            is_left = is_kept

    def sums(self, values: Floats) -> Floats:
        """Add up values of segments, in the order walked, over each section."""
        return np.bincount(self.owners, values, minlength=self.n_sections).astype(np.float64)

    def lines(self) -> "NDArray[np.object_]":
        """Give the sections as lines for shapely, shape (k,), object."""
        import shapely

        # every line begins with a point of its own, and each half-edge adds its end
        begin = self.begins[:-1]
        rows = np.concatenate([self.owners, np.arange(self.n_sections) - 0.5])
        order = np.argsort(rows, kind="stable")
        points = np.concatenate([self.points_walked[:, 1], self.points_walked[begin, 0]])[order]
        of_lines = np.ceil(rows[order]).astype(np.int64)
        return shapely.linestrings(self.drawing.points[points], indices=of_lines)

    def leaving(self) -> Points:
        """Give vectors from the two ends of each section to a point on its way.

        Returns
        -------
        ndarray of shape (k, 2, 2), float64
            The point lies :attr:`reach` along the drawn section, or at its other
            end if it is shorter.
        """
        points = self.drawing.points
        starts, stops = (points[self.points_walked[:, side]] for side in (0, 1))
        steps = np.sqrt(((stops - starts) ** 2).sum(axis=1))
        walked = np.concatenate([[0.0], np.cumsum(steps)])
        first, last = walked[self.begins[:-1]], walked[self.begins[1:]]
        targets = np.stack(
            [np.minimum(first + self.reach, last), np.maximum(last - self.reach, first)], axis=1
        )
        at = np.searchsorted(walked, targets, side="right") - 1
        at = np.clip(at, self.begins[:-1, None], self.begins[1:, None] - 1)
        share = ((targets - walked[at]) / steps[at])[..., None]
        places = starts[at] + np.clip(share, 0.0, 1.0) * (stops - starts)[at]
        vectors: Points = places - points[self.ends]
        return vectors


def find_sections(
    network: VeinNetwork, widths: Floats | None = None, lengths: Floats | None = None
) -> Sections:
    """Cut the veins of a network into sections.

    Parameters
    ----------
    network : VeinNetwork
        Any network in the plane; it may be empty. Veins that cross or touch meet
        there; segments without length are left out, and so is a segment that lies
        on another.
    widths : ndarray of shape (m,), float64, optional
        Widths of the segments; all the same if left out.
    lengths : ndarray of shape (m,), float64, optional
        Lengths of the segments along their course; the straight ones if left out.

    Returns
    -------
    Sections
        Without any section for a network without segments.
    """
    drawing = planar_drawing(network)
    origins = segment_origins(network, drawing)
    all_widths = np.ones(network.n_segments) if widths is None else widths
    drawn = _straight(drawing)
    if lengths is not None and len(origins):
        drawn = drawn * lengths[origins] / network.lengths[origins]
    segments = np.ascontiguousarray(drawing.segments, dtype=np.int32).reshape(-1, 2)
    firsts, leaving = kernels.sections.incidences(segments, len(drawing.points))
    seeds = _seed_points(network, drawing)
    is_stop = np.diff(firsts) != 2
    is_stop[seeds] = True
    walked, begins = kernels.sections.walk_sections(segments, firsts, leaving, is_stop)
    return Sections(
        Drawing(drawing.points, segments),
        drawn,
        all_widths[origins],
        walked,
        begins,
        seeds,
    )


def segment_origins(network: VeinNetwork, drawing: Drawing) -> NDArray[np.int64]:
    """Give for each segment of a drawing the row of the network's segment it is a piece of."""
    if drawing.segments is network.segments:
        return np.arange(network.n_segments)
    if not len(drawing.segments):
        return np.zeros(0, dtype=np.int64)
    import shapely

    has_length = np.flatnonzero(network.lengths > 0.0)
    tree = shapely.STRtree(shapely.linestrings(network.positions[network.segments[has_length]]))
    middles = drawing.points[drawing.segments].mean(axis=1)
    found = tree.query_nearest(shapely.points(middles), all_matches=False)
    origins: NDArray[np.int64] = has_length[found[1]]
    return origins


def _straight(drawing: Drawing) -> Floats:
    """Give the straight lengths of the segments of a drawing."""
    ends = drawing.points[drawing.segments.reshape(-1, 2)]
    return np.sqrt(((ends[:, 1] - ends[:, 0]) ** 2).sum(axis=1))


def _seed_points(network: VeinNetwork, drawing: Drawing) -> NDArray[np.int64]:
    """Give the rows of the points of a drawing at which seeds of the network lie."""
    seeds = np.flatnonzero((network.origins == Origin.SEED) & (network.degrees > 0))
    if drawing.segments is network.segments or not len(seeds):
        return seeds
    places = {tuple(place): row for row, place in enumerate(drawing.points.tolist())}
    rows = [places.get(tuple(place), -1) for place in network.positions[seeds].tolist()]
    return np.array([row for row in rows if row >= 0], dtype=np.int64)
