"""The loop that a segment closed, and what became of the tissue inside it."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from vasc.arrays import Ids, Points
from vasc.domain.rings import surrounds
from vasc.events import EventKind

if TYPE_CHECKING:
    from vasc.timeline import Frame, Timeline
    from vasc.validation.arabidopsis.story import SourceStory

SHORTEST = 1e-12
"""Length of a segment between coincident nodes; a graph takes 0 for no segment at all."""


class KeptFrames:
    """The frames of a timeline, each read once.

    Parameters
    ----------
    timeline : Timeline
        An open timeline.
    """

    def __init__(self, timeline: "Timeline") -> None:
        self.timeline = timeline
        self._frames: dict[int, Frame] = {}

    def at(self, step: int) -> "Frame":
        """Give a recorded step."""
        if step not in self._frames:
            self._frames[step] = self.timeline.frame(step)
        return self._frames[step]


def loop_nodes(frames: KeptFrames, row: int) -> Ids:
    """Give the nodes of the loop that a join closed, from one end of the join to the other.

    The loop is the join and the shortest way between its ends in the network
    as it was before: earlier segments that no earlier refinement had replaced.

    Parameters
    ----------
    frames : KeptFrames
        The frames of the run.
    row : int
        Row of the event ``LOOP_CLOSED``.

    Returns
    -------
    ndarray of shape (k,), int32
        Node ids, k >= 2; the two ends alone if no way leads from one to the other.
    """
    timeline = frames.timeline
    closing = int(timeline.events["subject"][row])
    step = int(timeline.events["step"][row])
    positions = frames.at(step).positions
    nodes = timeline.table("segments", "nodes")
    start, goal = nodes[closing].tolist()
    refined = _refined_before(timeline, row)
    earlier = np.setdiff1d(np.arange(closing, dtype=np.int32), refined)
    path = shortest_path(nodes[earlier], positions, start, goal)
    if len(path):
        return path
    # a writer may append the joins of a step before its extensions
    births = timeline.table("segments", "birth")
    is_closing = timeline.events["kind"] == EventKind.LOOP_CLOSED
    closings = timeline.events["subject"][is_closing & (timeline.events["step"] == step)]
    alive = np.setdiff1d(np.flatnonzero(births <= step), np.concatenate([refined, closings]))
    path = shortest_path(nodes[alive], positions, start, goal)
    return path if len(path) else np.array([start, goal], dtype=np.int32)


def _refined_before(timeline: "Timeline", row: int) -> Ids:
    """Give the segments that refinement had replaced before an event."""
    kinds, subjects = timeline.events["kind"][:row], timeline.events["subject"][:row]
    return subjects[kinds == EventKind.SEGMENT_REFINED]


def shortest_path(segments: Ids, positions: Points, start: int, goal: int) -> Ids:
    """Give the nodes of the shortest way along segments, both ends included.

    Parameters
    ----------
    segments : ndarray of shape (m, 2), int32
        Node ids.
    positions : ndarray of shape (n, 2), float64
        Of all nodes, in D.
    start, goal : int
        The ends.

    Returns
    -------
    ndarray of shape (k,), int32
        Empty if no way leads from one to the other.

    Examples
    --------
    >>> square = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]])
    >>> shortest_path(np.array([[0, 1], [1, 2]]), square, 0, 2).tolist()
    [0, 1, 2]
    """
    from scipy.sparse import csr_array
    from scipy.sparse.csgraph import dijkstra

    ends = positions[segments]
    lengths = np.maximum(np.sqrt(((ends[:, 1] - ends[:, 0]) ** 2).sum(axis=1)), SHORTEST)
    n_nodes = len(positions)
    graph = csr_array((lengths, (segments[:, 0], segments[:, 1])), shape=(n_nodes, n_nodes))
    _, before = dijkstra(graph, directed=False, indices=start, return_predecessors=True)
    path = [goal]
    while path[-1] != start:
        previous = int(before[path[-1]])
        if previous < 0:
            return np.zeros(0, dtype=np.int32)
        path.append(previous)
    return np.array(path[::-1], dtype=np.int32)


def first_inside(
    frames: KeptFrames, nodes: Ids, step: int, sources: Sequence["SourceStory"]
) -> int | None:
    """Give the first source born inside a loop after its closing, None if none was.

    The loop is the tissue it enclosed when it closed, wherever that is by then.

    Parameters
    ----------
    frames : KeptFrames
        The frames of the run.
    nodes : ndarray of shape (k,), int32
        Nodes of the loop.
    step : int
        Step at which it was closed.
    sources : sequence of SourceStory
        In the order of birth.
    """
    places = frames.timeline.table("sources", "position")
    for one in sources:
        if one.step > step and not one.is_on_margin:
            corners = frames.at(one.step).positions[nodes]
            if surrounds(corners, places[one.id]):
                return one.id
    return None
