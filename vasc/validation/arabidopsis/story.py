"""The story of a leaf: what the sequence checker knows of a run, and nothing else.

Owners name veins: 0 is the seed node, 1 the midvein (the vein of the first source), and the
vein of any source has the source's id and 1.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass

from vasc.validation.references import SEQUENCE

SEED = 0
MIDVEIN = 1


@dataclass(frozen=True)
class SourceStory:
    """Birth and end of one source.

    Parameters
    ----------
    id : int
        Row of the sources table.
    step, time : int, float
        When it was born.
    x, y : float
        Where, in leaf lengths at its birth: across from the axis, and up from the base.
    leaf_length : float
        The leaf then, in D.
    is_on_margin : bool
        Born on the margin.
    neighbors : frozenset of int or None
        Owners of the vein nodes it attracted at birth; None if the file does not say.
    drained_step, drained_time : int or None, float or None
        When it was drained; None if it lives.
    """

    id: int
    step: int
    time: float
    x: float
    y: float
    leaf_length: float
    is_on_margin: bool
    neighbors: frozenset[int] | None
    drained_step: int | None = None
    drained_time: float | None = None

    @property
    def owner(self) -> int:
        """Owner number of the veins that it causes."""
        return self.id + 1

    @property
    def side(self) -> int:
        """-1 left, 1 right, 0 on the axis: its own mirror image within the tolerance."""
        if 2.0 * abs(self.x) <= SEQUENCE.mirrored:
            return 0
        return -1 if self.x < 0.0 else 1


@dataclass(frozen=True)
class LoopStory:
    """A loop that a vein closed, as the polygon of tissue that it enclosed then.

    Parameters
    ----------
    source : int
        Source whose vein closed it.
    step, time : int, float
        When it was closed.
    owners : frozenset of int
        Owners of the nodes along it.
    areas : mapping of int to float
        Area of that tissue by step, in D^2: at every step at which a loop of the story was
        closed since, and at the last step.
    first_source : int or None
        The first source born inside it; None if none was.
    outline : tuple of (float, float)
        The polygon at the last step.
    """

    source: int
    step: int
    time: float
    owners: frozenset[int]
    areas: Mapping[int, float]
    first_source: int | None = None
    outline: tuple[tuple[float, float], ...] = ()


@dataclass(frozen=True)
class Ending:
    """How developing veins ended before and after mesophyll differentiated.

    Parameters
    ----------
    step, time : int or None, float or None
        When it did; None if the file tells of no such event.
    blind_before, blind_after : int
        Veins that ended blindly.
    joins_before, joins_after : int
        Veins that joined another.
    first_blind, first_blind_time : int or None, float or None
        The first blind end, None in a run without the event.
    """

    step: int | None
    time: float | None
    blind_before: int
    blind_after: int
    joins_before: int
    joins_after: int
    first_blind: int | None = None
    first_blind_time: float | None = None


@dataclass(frozen=True)
class Story:
    """All that the criteria look at.

    Parameters
    ----------
    sources : tuple of SourceStory
        In the order of their ids; the first is the midvein's.
    loops : tuple of LoopStory
        Loops closed by the veins of the lateral pairs, in the order of closing.
    ending : Ending
        Blind ends and joins.
    last_step, last_time : int, float
        The last recorded step.
    is_over : bool
        The run has ended, or growth has: what has not appeared will not appear.
    growth_ended, growth_ended_time : int or None, float or None
        When growth ended, None if the file does not say.
    heights : callable
        ``heights(source id, step)``: where the tissue at which a source was drained is at a
        later step, in leaf lengths from the base.
    lengths : callable
        ``lengths(step)``: length of the leaf at a step, in D.
    """

    sources: tuple[SourceStory, ...]
    loops: tuple[LoopStory, ...]
    ending: Ending
    last_step: int
    last_time: float
    is_over: bool
    growth_ended: int | None
    growth_ended_time: float | None
    heights: Callable[[int, int], float]
    lengths: Callable[[int], float]
