"""The genealogy of areoles of a run: read where a model records areoles, else found from veins."""

from pathlib import Path
from typing import TYPE_CHECKING, Protocol

import numpy as np

from vasc.arrays import NULL
from vasc.errors import TimelineError
from vasc.events import EventKind
from vasc.network import VeinNetwork
from vasc.timeline.frame import Frame
from vasc.timeline.genealogy import Genealogy, Loops

if TYPE_CHECKING:
    from vasc.faces import FaceWalks


class Recorded(Protocol):
    """What genealogies need of a timeline."""

    path: Path

    @property
    def dimensions(self) -> int:
        """2 in the plane, 3 in space."""

    def n_rows(self, table: str) -> int:
        """Give the number of rows of a table."""

    def frame(self, step: int = -1) -> Frame:
        """Give a recorded step."""


def genealogy_of(timeline: Recorded, step: int = -1) -> tuple[Genealogy, Loops | None]:
    """Give the genealogy of the areoles of a run.

    Where the model records areoles, it is read. Elsewhere it is found from the veins of the
    step: the segments that closed loops are taken out, the newest first, and the two faces
    that each divides become one. Where veins cross without a node, the faces around the
    crossing count as one; a network that lies in an areole of another is not seen as in it.

    Parameters
    ----------
    timeline : Timeline
        An open timeline.
    step : int
        The last step to look at, -1 for the last one recorded.

    Returns
    -------
    genealogy : Genealogy
        Empty when no loop is closed.
    loops : Loops or None
        Which areole lies on each side of a segment, where it was found from the veins.

    Raises
    ------
    TimelineError
        If the run is one of a stem, whose loops are not in a plane.
    """
    if timeline.dimensions != 2:
        raise TimelineError(f"{timeline.path}: is a stem; areoles are loops in the plane alone")
    frame = timeline.frame(step)
    if timeline.n_rows("areoles"):
        return _recorded(frame)
    return _found(frame)


def _recorded(frame: Frame) -> tuple[Genealogy, None]:
    """Read what a model of areoles records."""
    events = {name: frame.rows("events", name) for name in ("step", "kind", "subject")}
    n_areoles = frame.n_rows("areoles")
    splits = np.full(n_areoles, NULL, dtype=np.int32)
    is_split = events["kind"] == EventKind.AREOLE_SPLIT
    splits[events["subject"][is_split]] = events["step"][is_split]
    births, parents, segments = (
        frame.rows("areoles", name) for name in ("birth", "parent", "segment")
    )
    whole = frame.areoles
    boundaries = dict(zip(whole.ids.tolist(), whole.boundaries, strict=True))
    return Genealogy(births, parents, segments, splits, boundaries), None


def _found(frame: Frame) -> tuple[Genealogy, Loops]:
    """Take out the segments that closed loops, newest first, and note which faces meet."""
    from vasc.faces import Drawing, face_walks

    network = frame.network
    empty = np.empty(0, dtype=np.int32)
    if network.n_segments == 0:
        return Genealogy(empty, empty, empty, empty, {}), Loops(empty, empty)
    walks = face_walks(Drawing(network.positions, network.segments))
    merged = _Merged(walks)
    for segment, row, step in _closures(frame):
        merged.take_out(segment, row, step)
    return merged.genealogy()


def _closures(frame: Frame) -> list[tuple[int, int, int]]:
    """Give each segment that closed a loop, a living piece of it, and the step; newest first.

    There has to be a segment.
    """
    events = {name: frame.rows("events", name) for name in ("step", "kind", "subject")}
    growths = frame.network.growths
    pieces = frame.network.segment_ids if growths is None else growths.ids
    # the first living piece of each
    order = np.argsort(pieces, kind="stable")
    closed = np.flatnonzero(events["kind"] == EventKind.LOOP_CLOSED)[::-1]
    segments, steps = events["subject"][closed], events["step"][closed]
    places = np.searchsorted(pieces[order], segments)
    rows = order[np.minimum(places, len(order) - 1)]
    is_alive = pieces[rows] == segments
    found = list(
        zip(*(values[is_alive].tolist() for values in (segments, rows, steps)), strict=True)
    )
    known = {segment for segment, _, _ in found}
    given = [one for one in _given_closures(frame.network) if int(pieces[one]) not in known]
    return found + [(int(pieces[row]), row, 0) for row in given[::-1]]


def _given_closures(network: VeinNetwork) -> list[int]:
    """Give the segments that close loops of given veins, by row: no event tells of them."""
    above: dict[int, int] = {}

    def top(node: int) -> int:
        while (upper := above.get(node, node)) != node:
            above[node] = above.get(upper, upper)
            node = upper
        return node

    closing = []
    for row in np.flatnonzero(network.vein_births == 0).tolist():
        first, second = (top(node) for node in network.segments[row].tolist())
        if first == second:
            closing.append(row)
        above[first] = second
    return closing


class _Merged:
    """Faces of a network, which become fewer as the segments between them are taken out."""

    def __init__(self, walks: "FaceWalks") -> None:
        self.walks = walks
        n_faces = len(walks.areas)
        self.above = list(range(n_faces))
        # what is outside one component is outside all
        outside = np.flatnonzero(walks.is_outside).tolist()
        for face in outside:
            self.above[face] = outside[0]
        self.outside = outside[0]
        # an areole for every face, and for every union of faces when it is made
        self.areoles = list(range(n_faces))
        self.births: list[list[int]] = [[NULL, NULL, NULL] for _ in range(n_faces)]
        self.splits = [NULL] * n_faces
        self.order: list[int] = []

    def take_out(self, segment: int, row: int, step: int) -> None:
        """Unite the faces beside a segment: they were born, and their union split, at a step."""
        faces, n_segments = self.walks.faces, len(self.walks.faces) // 2
        first, second = self._top(int(faces[row])), self._top(int(faces[row + n_segments]))
        if first == second:
            return
        if second == self.outside:
            first, second = second, first
        born = [self.areoles[second]]
        parent = NULL
        if first != self.outside:
            born.append(self.areoles[first])
            parent = len(self.splits)
            self.splits.append(step)
            self.births.append([NULL, NULL, NULL])
            self.areoles[first] = parent
        for areole in born:
            self.births[areole] = [step, parent, segment]
        self.order += born
        self.above[second] = first

    def genealogy(self) -> tuple[Genealogy, Loops]:
        """Give all areoles, numbered by birth."""
        order = self.order[::-1]
        numbers = np.full(len(self.splits) + 1, NULL, dtype=np.int32)
        numbers[order] = np.arange(len(order), dtype=np.int32)
        births = np.array(self.births, dtype=np.int32).reshape(-1, 3)[order]
        splits = np.array(self.splits, dtype=np.int32)[order]
        n_faces = len(self.walks.areas)
        _, half_edges = np.unique(self.walks.faces, return_index=True)
        boundaries = {
            int(numbers[face]): np.array(self.walks.around(int(half_edges[face])), dtype=np.int32)
            for face in range(n_faces)
            if numbers[face] != NULL
        }
        # the null of a parent stays null: it looks up the last entry
        found = Genealogy(births[:, 0], numbers[births[:, 1]], births[:, 2], splits, boundaries)
        return found, Loops(self.walks.starts, numbers[self.walks.faces])

    def _top(self, face: int) -> int:
        """Give the union that a face is in."""
        while self.above[face] != face:
            self.above[face] = self.above[self.above[face]]
            face = self.above[face]
        return face
