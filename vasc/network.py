"""Vein networks: nodes and the segments between them."""

from dataclasses import dataclass, field
from enum import IntEnum
from functools import cached_property

import numpy as np

from vasc.arrays import Codes, Column, Floats, Ids, Points, Steps
from vasc.notebook import card, picture_of


class Origin(IntEnum):
    """How a node came to be."""

    SEED = 0
    EXTENSION = 1
    SOURCE = 2
    REFINEMENT = 3
    PRIMORDIUM = 4
    CANAL = 5
    """A cell of a canal that has differentiated as a whole."""


class SegmentKind(IntEnum):
    """How a segment came to be."""

    EXTENSION = 0
    JOIN = 1
    REFINEMENT = 2


NODE_COLUMNS = {
    "birth": Column("i4", "step of birth"),
    "parent": Column("i4", "node it extends, -1 for a seed"),
    "origin": Column("i1", "0 seed, 1 extension, 2 source, 3 refinement, 4 primordium, 5 canal"),
    "source": Column("i4", "source that caused it (the nearest that pulled), -1 if none"),
    "position": Column("f8", "position at birth", unit="length", shape=(2,)),
    "material": Column("f8", "material coordinates", unit="length", shape=(2,)),
}

SEGMENT_COLUMNS = {
    "nodes": Column("i4", "the two nodes, proximal first", shape=(2,)),
    "birth": Column("i4", "step of birth"),
    "kind": Column("i1", "0 extension, 1 join, 2 refinement"),
}


@dataclass(frozen=True)
class Growths:
    """The growth event that made the vein in each of some segments.

    Parameters
    ----------
    ids : ndarray of shape (m,), int32
        The segment that grew there: the segment itself, unless refinement made it.
    nodes : ndarray of shape (m,), int32
        The newer node of that segment.
    births : ndarray of shape (m,), int32
        The step in which it grew.
    causes : ndarray of shape (m,), int32
        The source that caused it, -1 if none.
    """

    ids: Ids
    nodes: Ids
    births: Steps
    causes: Ids


@dataclass(frozen=True)
class VeinNetwork:
    """A vein network at one step: every node, and the segments alive then.

    Parameters
    ----------
    positions : ndarray of shape (n, d), float64
        Where the nodes are at this step; row = node id.
    parents : ndarray of shape (n,), int32
        The node each node extends, -1 for a seed.
    births : ndarray of shape (n,), int32
        Steps of birth.
    origins : ndarray of shape (n,), int8
        Values of :class:`Origin`.
    causes : ndarray of shape (n,), int32
        The source that caused each node, -1 if none.
    segments : ndarray of shape (m, 2), int32
        Node ids of the segments alive at this step, proximal node first.
    segment_ids, segment_births : ndarray of shape (m,), int32
        Their ids (rows of the segments table) and steps of birth.
    segment_kinds : ndarray of shape (m,), int8
        Values of :class:`SegmentKind`.
    retired : ndarray of shape (r,), int32
        Ids of nodes that refinement has replaced: they are in no segment any more.
    growths : Growths or None
        The growth event behind each segment; None where none is known, as in a real
        leaf.
    """

    positions: Points
    parents: Ids
    births: Steps
    origins: Codes
    causes: Ids
    segments: Ids
    segment_ids: Ids
    segment_births: Steps
    segment_kinds: Codes
    retired: Ids = field(default_factory=lambda: np.empty(0, dtype=np.int32))
    growths: Growths | None = None

    def __repr__(self) -> str:
        return f"VeinNetwork(nodes={self.n_vein_nodes}, segments={self.n_segments})"

    def _repr_html_(self) -> str:
        """Show a small picture in a notebook."""
        facts = {
            "nodes": lambda: self.n_vein_nodes,
            "segments": lambda: self.n_segments,
            "vein length": lambda: f"{float(self.lengths.sum()):.4g}",
        }
        return card("VeinNetwork", facts, lambda: picture_of(self.positions, self.segments))

    @property
    def vein_births(self) -> Steps:
        """Step in which the vein in each segment grew, shape (m,), int32."""
        return self.segment_births if self.growths is None else self.growths.births

    @property
    def n_nodes(self) -> int:
        """Number of nodes, retired ones as well: ids are less than that."""
        return len(self.positions)

    @property
    def n_vein_nodes(self) -> int:
        """Number of nodes that are part of a vein, or a seed."""
        return len(self.positions) - len(self.retired)

    @property
    def n_segments(self) -> int:
        """Number of segments alive."""
        return len(self.segments)

    @cached_property
    def degrees(self) -> Ids:
        """Segments that meet at each node, shape (n,), int32."""
        return np.bincount(self.segments.ravel(), minlength=self.n_nodes).astype(np.int32)

    @cached_property
    def lengths(self) -> Floats:
        """Lengths of the segments, shape (m,)."""
        ends = self.positions[self.segments]
        return np.sqrt(((ends[:, 1] - ends[:, 0]) ** 2).sum(axis=1))
