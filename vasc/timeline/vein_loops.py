"""The loop in which a vein lies: the areole it grew in, and the first-order loop around that."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from vasc.arrays import NULL
from vasc.events import EventKind
from vasc.timeline import run_genealogy
from vasc.timeline.genealogy import Genealogy, Loops
from vasc.timeline.veins import Veins


class Recorded(run_genealogy.Recorded, Protocol):
    """What the loop of a vein needs of a timeline."""

    @property
    def events(self) -> Mapping[str, NDArray]:
        """Columns of the events."""

    def table(self, name: str, column: str, start: int = 0, stop: int | None = None) -> NDArray:
        """Read rows of a column."""


@dataclass(frozen=True)
class VeinLoop:
    """Where a vein lies among the loops.

    Parameters
    ----------
    node : int
        The node that was asked for.
    vein : int
        The first node of its vein.
    branching_order : int
        Branching order of the vein.
    areole : int
        The areole the vein grew in, -1 if in open tissue.
    first_order : int
        The first-order loop around it, -1 if in open tissue.
    ancestors : tuple of int
        What the areole was split from, nearest first.
    """

    node: int
    vein: int
    branching_order: int
    areole: int
    first_order: int
    ancestors: tuple[int, ...]


def loop_of(
    timeline: Recorded, veins: Veins, known: tuple[Genealogy, Loops | None], node: int
) -> VeinLoop:
    """Tell in which loop the vein of a node lies.

    Parameters
    ----------
    timeline : Timeline
        An open timeline.
    veins : Veins
        The veins of its nodes.
    known : tuple of Genealogy and Loops or None
        What :func:`vasc.timeline.run_genealogy.genealogy_of` gives.
    node : int
        A node that exists.

    Returns
    -------
    VeinLoop
    """
    tree, loops = known
    vein = int(veins.firsts[node])
    if loops is None:
        areole = _enclosing(timeline, vein)
    else:
        birth = int(timeline.table("nodes", "birth", vein, vein + 1)[0])
        beside = loops.beside(np.flatnonzero(veins.firsts == vein).astype(np.int32))
        # the sides of a vein were one areole before it grew, so that any of them leads there
        areole = int(beside[0]) if len(beside) and birth > 0 else NULL
        areole = tree.alive_before(areole, birth)
    ancestors = () if areole == NULL else tree.ancestors(areole)
    first = (areole, *ancestors)[-1]
    return VeinLoop(node, vein, int(veins.orders[node]), areole, first, ancestors)


def _enclosing(timeline: Recorded, vein: int) -> int:
    """Give the areole in which the source appeared that caused a vein, -1 if in none."""
    source = int(timeline.table("nodes", "source", vein, vein + 1)[0])
    events = timeline.events
    is_its = (events["kind"] == EventKind.SOURCE_ENCLOSED) & (events["subject"] == source)
    return int(events["object"][is_its][0]) if is_its.any() and source != NULL else NULL
