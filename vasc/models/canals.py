"""Canals: polarized tissue between a source and its relative neighbors (Runions 2008, 5.2.3)."""

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from vasc import kernels
from vasc.arrays import NULL, Floats, Ids, Points
from vasc.canals import CANAL_TABLES, canals_from_columns
from vasc.events import EventKind
from vasc.models.perception import Cut, Perception
from vasc.network import Origin
from vasc.placement import Moment
from vasc.sources import Cause
from vasc.states import CanalState, Kind, check_transitions
from vasc.vasculature import Vasculature

ROUNDING = 1e-6
"""Distances from a source that differ by less, in D, are equal."""

UNDER_WAY = (CanalState.INBOUND, CanalState.OUTBOUND)
ENDED = (CanalState.VEIN, CanalState.ARRESTED)


@dataclass
class Canal:
    """One canal: the tissue between a source and a vein node."""

    id: int
    """Row of the perceived table."""
    source: int
    node: int
    """The vein node it leads to, or begins at if it is the inbound one."""
    state: CanalState = CanalState.GROUND
    tip: int = NULL
    """The vein node at the end of the strand that differentiates along it."""


@dataclass
class Canals:
    """All canals that are not differentiated along their whole length.

    Attributes
    ----------
    by_source : dict of int to list of Canal
        Canals of a source, in the order of its relative neighbors.
    drained : dict of int to int
        The vein node that each source drained in the last step became.
    """

    by_source: dict[int, list[Canal]] = field(default_factory=dict)
    drained: dict[int, int] = field(default_factory=dict)

    def under_way(self) -> list[Canal]:
        """Give the canals along which a strand differentiates, in the order of their ids."""
        found = [c for canals in self.by_source.values() for c in canals if c.state in UNDER_WAY]
        return sorted(found, key=lambda canal: canal.id)

    def change(self, veins: Vasculature, step: int, canal: Canal, state: CanalState) -> None:
        """Let a canal pass into another state."""
        check_transitions(Kind.CANAL, canal.state, state)
        canal.state = state
        veins.log_states(step, np.array([canal.id], dtype=np.int32), state, Kind.CANAL)
        if state in ENDED:
            remaining = [other for other in self.by_source[canal.source] if other is not canal]
            self.by_source[canal.source] = remaining
            if not remaining:
                del self.by_source[canal.source]


class CanalPerception(Perception[Canals]):
    """Relative neighbors are perceived when a source is born, and stored as canals.

    Only the canal of the closest of them differentiates at once, toward the
    source; the others do so away from it, once it is drained.

    Parameters
    ----------
    canals : Canals
        Where they are kept.
    tie : float
        Neighbours farther than the closest by at most that are as close, D.
    lean : float
        A vein to a source within the blade leaves another one that share of its length
        nearer to the base.
    """

    def __init__(self, canals: Canals, tie: float, lean: float = 0.0) -> None:
        self.canals = canals
        self.tie = tie
        self.lean = lean
        self._n_sources = 0

    def look(self, veins: Vasculature, n_nodes: int) -> None:
        """Do nothing: what a source induced at its birth stays."""

    def is_stuck(self, veins: Vasculature) -> bool:
        """Say no: every strand comes nearer to where it leads."""
        return False

    def perceive(self, veins: Vasculature, moment: Moment) -> Canals:
        """Let new sources induce canals, and drained ones let theirs differentiate."""
        step = moment.step
        for source, node in self.canals.drained.items():
            for canal in self.canals.by_source.get(source, []):
                canal.tip = node
                self.canals.change(veins, step, canal, CanalState.OUTBOUND)
        self.canals.drained.clear()
        for source in range(self._n_sources, veins.sources.n_rows):
            self._induce(veins, moment, source)
        self._n_sources = veins.sources.n_rows
        return self.canals

    def held(self, veins: Vasculature) -> Ids:
        """Give the tips of all strands, and the nodes that sources became."""
        tips = [canal.tip for canal in self.canals.under_way()]
        return np.array(sorted({*tips, *self.canals.drained.values()}), dtype=np.int32)

    def follow(self, veins: Vasculature, moment: Moment, cuts: Sequence[Cut]) -> None:
        """Let canals lead to the nearer of the two nodes that replace one."""
        places, sources = veins.places("nodes"), veins.places("sources")
        for cut in cuts:
            for canals in self.canals.by_source.values():
                for canal in canals:
                    if canal.node != cut.node or canal.state == CanalState.INBOUND:
                        continue
                    is_pending = canal.state == CanalState.PRE_PATTERN
                    origin = sources[canal.source] if is_pending else places[canal.tip]
                    gaps = [((places[n] - origin) ** 2).sum() for n in (cut.first, cut.second)]
                    canal.node = cut.first if gaps[0] <= gaps[1] else cut.second
                    veins.log(moment.step, EventKind.CANAL_RETARGETED, canal.id, canal.node)

    def _induce(self, veins: Vasculature, moment: Moment, source: int) -> None:
        """Store the canals of a new source; that of its closest relative neighbor begins."""
        nodes, distances = relative_neighbors(veins, veins.places("sources")[source])
        table = veins.tables["perceived"]
        rows = table.append(step=moment.step, source=source, node=nodes)
        ids = range(rows.start, rows.stop)
        canals = [Canal(i, source, node) for i, node in zip(ids, nodes.tolist(), strict=True)]
        self.canals.by_source[source] = canals
        for canal in canals:
            self.canals.change(veins, moment.step, canal, CanalState.PRE_PATTERN)
        row = self._closest(veins, nodes, distances)
        closest = canals[row]
        # leaning laterals part from the older loops: sources on the margin then lose them
        is_marginal = veins.sources.arrays["cause"][source] == Cause.MARGIN
        lean = 0.0 if is_marginal else self.lean
        closest.tip = _toward_base(veins, closest.node, lean * float(distances[row]))
        self.canals.change(veins, moment.step, closest, CanalState.INBOUND)

    def _closest(self, veins: Vasculature, nodes: Ids, distances: Floats) -> int:
        """Give the row of the closest neighbor; of equals that of the oldest vein, the lowest."""
        rows = np.flatnonzero(distances <= distances.min() + self.tie)
        places = veins.places("nodes")[nodes[rows]]
        # the seed and the first vein count as one
        veins_of = np.maximum(veins.nodes.arrays["source"][nodes[rows]], 0)
        order = np.lexsort((np.abs(places[:, 0]), places[:, 1], veins_of))
        return int(rows[order[0]])

    def restore(self, veins: Vasculature) -> None:
        """Put back the canals that a record describes."""
        tables = {
            table: {name: veins.tables[table].view(name) for name in columns}
            for table, columns in CANAL_TABLES.items()
        }
        found = canals_from_columns(tables, veins.sources.view("position"))
        is_source = tables["nodes"]["origin"] == Origin.SOURCE
        owners = tables["nodes"]["source"][is_source].tolist()
        became = dict(zip(owners, np.flatnonzero(is_source).tolist(), strict=True))
        columns = (found.ids, found.sources, found.nodes, found.states, found.tips)
        for row, source, node, code, tip in zip(*(c.tolist() for c in columns), strict=True):
            state = CanalState(code)
            if state in ENDED:
                continue
            canal = Canal(row, source, node, state, tip)
            self.canals.by_source.setdefault(source, []).append(canal)
            if state == CanalState.PRE_PATTERN and source in became:
                self.canals.drained[source] = became[source]
        self._n_sources = veins.sources.n_rows


def relative_neighbors(veins: Vasculature, place: Points) -> tuple[Ids, Floats]:
    """Give the relative neighbors of a place among the vein nodes, nearest first.

    Ties are resolved by height and distance from the midline, so that a leaf and
    its mirror image have mirrored neighbors.

    Returns
    -------
    nodes : ndarray of shape (k,), int32
        Node ids.
    distances : ndarray of shape (k,), float64
        Their distances.
    """
    nodes = np.flatnonzero(~veins.is_retired[: veins.nodes.n_rows]).astype(np.int32)
    places = veins.places("nodes")[nodes]
    distances = np.sqrt(((places - place) ** 2).sum(axis=1))
    keys = (places[:, 0], np.abs(places[:, 0]), places[:, 1], np.round(distances / ROUNDING))
    order = np.lexsort(keys)
    rows = order[kernels.canals.ordered_neighbors(places[order], distances[order])]
    return nodes[rows], distances[rows]


def _toward_base(veins: Vasculature, node: int, length: float) -> int:
    """Give the node that lies a length from another one along its vein, nearer to a seed.

    The walk ends where veins branch.
    """
    if length <= 0.0:
        return node
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import dijkstra

    n_nodes = veins.nodes.n_rows
    ends = veins.segments.view("nodes")[~veins.refined[: veins.segments.n_rows]]
    places = veins.places("nodes")
    lengths = np.sqrt(((places[ends[:, 1]] - places[ends[:, 0]]) ** 2).sum(axis=1))
    graph = coo_array((lengths, (ends[:, 0], ends[:, 1])), shape=(n_nodes, n_nodes)).tocsr()
    seeds = np.flatnonzero(veins.nodes.view("origin") == Origin.SEED)
    to_base = dijkstra(graph, directed=False, indices=seeds, min_only=True)
    degrees = np.bincount(ends.ravel(), minlength=n_nodes)
    start = to_base[node]
    while degrees[node] == 2 and start - to_base[node] < length:
        around = ends[(ends == node).any(axis=1)].ravel()
        node = int(around[np.argmin(to_base[around])])
    return node
