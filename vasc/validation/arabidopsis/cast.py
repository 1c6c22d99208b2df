"""Who is who in a story: the tip source, the pairs on the margin, the loops they close."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

from vasc.validation.arabidopsis.story import MIDVEIN, LoopStory, SourceStory, Story
from vasc.validation.references import SEQUENCE


@dataclass(frozen=True)
class Pair:
    """Two sources, mirror images of each other within the tolerances."""

    left: SourceStory
    right: SourceStory

    @property
    def sides(self) -> tuple[SourceStory, SourceStory]:
        """Both."""
        return self.left, self.right

    @property
    def step(self) -> int:
        """Step of the first birth."""
        return min(self.left.step, self.right.step)

    @property
    def time(self) -> float:
        """Time of the first birth."""
        return min(self.left.time, self.right.time)

    @property
    def height(self) -> float:
        """Distance from the base over leaf length, at birth."""
        return (self.left.y + self.right.y) / 2.0

    @property
    def is_on_margin(self) -> bool:
        """Both are."""
        return self.left.is_on_margin and self.right.is_on_margin

    @property
    def ids(self) -> set[int]:
        """The two ids."""
        return {self.left.id, self.right.id}


@dataclass(frozen=True)
class LoopPair:
    """The loops of both sides that belong together."""

    left: LoopStory
    right: LoopStory

    @property
    def sides(self) -> tuple[LoopStory, LoopStory]:
        """Both."""
        return self.left, self.right

    @property
    def step(self) -> int:
        """Step at which the later one was closed."""
        return max(self.left.step, self.right.step)

    @property
    def time(self) -> float:
        """Time at which the later one was closed."""
        return max(self.left.time, self.right.time)

    def area(self, step: int) -> float:
        """Area of both sides together at a step, in D^2."""
        return self.left.areas[step] + self.right.areas[step]

    def first_source(self, story: Story) -> SourceStory | None:
        """Give the first source born inside one of the two."""
        ids = [loop.first_source for loop in self.sides if loop.first_source is not None]
        return min((story.sources[each] for each in ids), key=lambda one: one.time, default=None)


def mirror_pairs(sources: Sequence[SourceStory]) -> list[Pair]:
    """Pair sources that are born together as mirror images, oldest first.

    Each source is in one pair at most; of several partners the nearest to the
    mirror image is taken.
    """
    lateral = sorted((one for one in sources if one.side), key=lambda one: (one.time, one.id))
    paired: set[int] = set()
    pairs = []
    for row, one in enumerate(lateral):
        if one.id in paired:
            continue
        partners = []
        for other in lateral[row + 1 :]:
            if other.time - one.time > SEQUENCE.pair_time:
                break
            if other.id not in paired and other.side == -one.side and _mirrored(one, other):
                partners.append(other)
        if partners:
            other = min(partners, key=lambda each: _gap(one, each))
            paired |= {one.id, other.id}
            pairs.append(Pair(one, other) if one.side < 0 else Pair(other, one))
    return pairs


def _gap(one: SourceStory, other: SourceStory) -> float:
    """Give the larger of the two distances to a mirror image, in leaf lengths."""
    return max(abs(one.x + other.x), abs(one.y - other.y))


def _mirrored(one: SourceStory, other: SourceStory) -> bool:
    """Tell whether two sources are mirror images within the tolerance."""
    return _gap(one, other) <= SEQUENCE.mirrored


@dataclass(frozen=True)
class Cast:
    """The actors of a story; one that has not appeared is None.

    The first pair is the first one on the margin, the upper pair the first on the
    margin after it that is nearer the tip, the second and the third pair the first
    on the margin that are nearer the base than the pair before.
    """

    story: Story

    @cached_property
    def tip(self) -> SourceStory | None:
        """The first source, the midvein's."""
        return self.story.sources[0] if self.story.sources else None

    @cached_property
    def pairs(self) -> list[Pair]:
        """All pairs after the first source."""
        return mirror_pairs(self.story.sources[1:])

    @cached_property
    def pair_1(self) -> Pair | None:
        """The lower halves of the first loops."""
        return next((pair for pair in self.pairs if pair.is_on_margin), None)

    @cached_property
    def upper(self) -> Pair | None:
        """The upper halves of the first loops."""
        return self._next(self.pair_1, distal=True)

    @cached_property
    def pair_2(self) -> Pair | None:
        """The second loops."""
        return self._next(self.pair_1, distal=False)

    @cached_property
    def pair_3(self) -> Pair | None:
        """The third loops."""
        return self._next(self.pair_2, distal=False)

    @cached_property
    def loop_1(self) -> LoopPair | None:
        """Closed by the upper pair with midvein and first pair."""
        return self._closed(self.upper, (self.pair_1,))

    @cached_property
    def loop_2(self) -> LoopPair | None:
        """Closed by the second pair with midvein and first loop."""
        return self._closed(self.pair_2, (self.pair_1, self.upper))

    @cached_property
    def loop_3(self) -> LoopPair | None:
        """Closed by the third pair with midvein and second loop."""
        return self._closed(self.pair_3, (self.pair_2, self.pair_1))

    def _next(self, before: Pair | None, *, distal: bool) -> Pair | None:
        """Give the first later pair on the margin on one side of a pair."""
        if before is None:
            return None
        for pair in self.pairs[self.pairs.index(before) + 1 :]:
            if pair.is_on_margin and (pair.height > self._height(before, pair.step)) == distal:
                return pair
        return None

    def _height(self, pair: Pair, step: int) -> float:
        """Give where the tissue of a pair is at a later step."""
        heights = [self.story.heights(one.id, step) for one in pair.sides]
        return sum(heights) / len(heights)

    def _closed(self, pair: Pair | None, older: tuple[Pair | None, ...]) -> LoopPair | None:
        """Give the loops that a pair closed with the midvein and an older vein, on both sides."""
        if pair is None:
            return None
        found = []
        for side, source in enumerate(pair.sides):
            owners = {each.sides[side].owner for each in older if each is not None}
            of_side = (
                loop
                for loop in self.story.loops
                if loop.source == source.id and MIDVEIN in loop.owners and owners & loop.owners
            )
            found.append(next(of_side, None))
        left, right = found
        return None if left is None or right is None else LoopPair(left, right)
