"""Criteria about places, neighbors, loops and areas (C1, C3 to C9, C14 to C17)."""

from collections.abc import Sequence

from vasc.validation.arabidopsis.cast import Cast, LoopPair, Pair
from vasc.validation.arabidopsis.story import MIDVEIN, SEED, SourceStory
from vasc.validation.arabidopsis.verdicts import Verdict, absent, judged, undecided
from vasc.validation.references import SEQUENCE

NOT_FINAL = "areas are not final: growth has not ended"
NO_NEIGHBORS = "the file does not record what sources attract"


def tip_is_first(cast: Cast) -> Verdict:
    """C1: the first source is at the tip and sees the seed alone."""
    tip = cast.tip
    if tip is None:
        return absent(cast.story, "no source")
    value = f"step {tip.step}, at {tip.y:.2f} of the leaf length"
    if max(abs(1.0 - tip.y), abs(tip.x)) > SEQUENCE.tip:
        return Verdict(False, value, f"the first source is at ({tip.x:.2f}, {tip.y:.2f})")
    if tip.neighbors is None:
        return undecided(NO_NEIGHBORS)
    return judged(
        tip.neighbors == {SEED}, value, f"its neighbors belong to veins {_listed(tip.neighbors)}"
    )


def first_pair(cast: Cast) -> Verdict:
    """C3: half-way on the margin, with the midvein alone as neighbor."""
    first = next((one for one in cast.story.sources[1:] if one.side), None)
    if first is None:
        return absent(cast.story, "no lateral source")
    pair = cast.pair_1
    if pair is None or first.id not in pair.ids:
        return _not_paired(cast, first)
    low, high = SEQUENCE.half_way
    problems = _problems(pair, [({MIDVEIN}, {MIDVEIN})] * 2)
    if not low <= pair.height <= high:
        problems.insert(0, f"it is at {pair.height:.2f} of the leaf length")
    return _pair_verdict(pair, problems)


def upper_pair(cast: Cast) -> Verdict:
    """C4: nearer the tip, with midvein and first pair among its neighbors."""
    older = cast.pair_1
    if older is None:
        return undecided("there is no first pair")
    pair = cast.upper
    if pair is None:
        return absent(cast.story, "no later pair on the margin nearer the tip than the first")
    asked = [({MIDVEIN, source.owner}, None) for source in older.sides]
    return _pair_verdict(pair, _problems(pair, asked))


def second_pair(cast: Cast) -> Verdict:
    """C6: nearer the base, between midvein and first pair."""
    return _basal_pair(cast, cast.pair_2, cast.pair_1, "first")


def third_pair(cast: Cast) -> Verdict:
    """C8: nearer the base, between midvein and second pair."""
    return _basal_pair(cast, cast.pair_3, cast.pair_2, "second")


def first_loops(cast: Cast) -> Verdict:
    """C5: closed on both sides, with midvein and first pair."""
    return _loops(cast, cast.upper, cast.loop_1, "the upper pair")


def second_loops(cast: Cast) -> Verdict:
    """C7: closed on both sides, with midvein and first loops."""
    return _loops(cast, cast.pair_2, cast.loop_2, "the second pair")


def third_loops(cast: Cast) -> Verdict:
    """C9: closed on both sides, with midvein and second loops."""
    return _loops(cast, cast.pair_3, cast.loop_3, "the third pair")


def second_smaller_when_formed(cast: Cast) -> Verdict:
    """C14: area of the second loops over the first, at closing."""
    ratio = area_ratio(cast.loop_2, cast.loop_1)
    return _ratio(ratio, (0.0, SEQUENCE.formed_ratio), is_open=True)


def second_larger_in_the_end(cast: Cast) -> Verdict:
    """C15: the same at the last step, when growth is over."""
    if not cast.story.is_over:
        return undecided(NOT_FINAL)
    ratio = area_ratio(cast.loop_2, cast.loop_1, cast.story.last_step)
    return _ratio(ratio, (SEQUENCE.formed_ratio, float("inf")), is_open=True)


def third_smaller_when_formed(cast: Cast) -> Verdict:
    """C16: area of the third loops over the second, at closing."""
    ratio = area_ratio(cast.loop_3, cast.loop_2)
    return _ratio(ratio, (0.0, SEQUENCE.third_formed_ratio), is_open=True)


def third_alike_in_the_end(cast: Cast) -> Verdict:
    """C17: the same at the last step, when growth is over."""
    if not cast.story.is_over:
        return undecided(NOT_FINAL)
    ratio = area_ratio(cast.loop_3, cast.loop_2, cast.story.last_step)
    return _ratio(ratio, SEQUENCE.third_final_ratio, is_open=False)


def area_ratio(
    younger: LoopPair | None, older: LoopPair | None, step: int | None = None
) -> float | str:
    """Give the area of two loops over that of two older ones, or why there is none.

    Parameters
    ----------
    younger, older : LoopPair or None
        Both sides of each are taken together.
    step : int, optional
        By default the step at which the younger were closed.
    """
    if younger is None or older is None:
        return "the two loops are not both closed on both sides"
    if step is None:
        step = younger.step
    if step < older.step:
        # the polygon is frozen at closing: before that there is none to measure
        step = older.step
    area = older.area(step)
    return younger.area(step) / area if area > 0.0 else "the older loop has no area"


def _ratio(ratio: float | str, bounds: tuple[float, float], *, is_open: bool) -> Verdict:
    """Hold a ratio against its bounds."""
    if isinstance(ratio, str):
        return undecided(ratio)
    low, high = bounds
    passed = low < ratio < high if is_open else low <= ratio <= high
    return judged(passed, round(ratio, 4), f"the ratio is {ratio:.2f}")


def _basal_pair(cast: Cast, pair: Pair | None, older: Pair | None, name: str) -> Verdict:
    """Judge a pair that has to lie between midvein and an older pair's veins."""
    if older is None:
        return undecided(f"there is no {name} pair")
    if pair is None:
        what = f"no later pair on the margin nearer the base than the {name}"
        return absent(cast.story, what)
    exact = [{MIDVEIN, source.owner} for source in older.sides]
    return _pair_verdict(pair, _problems(pair, [(owners, owners) for owners in exact]))


def _problems(pair: Pair, asked: Sequence[tuple[set[int], set[int] | None]]) -> list[str]:
    """Say what is wrong with a pair: margin, and the needed and the allowed neighbors."""
    problems = [] if pair.is_on_margin else ["it is not on the margin"]
    for source, (needed, allowed) in zip(pair.sides, asked, strict=True):
        if source.neighbors is None:
            continue
        # the seed is the lower end of the midvein
        owners = {MIDVEIN if owner == SEED else owner for owner in source.neighbors}
        if not needed <= owners or (allowed is not None and not owners <= allowed):
            problems.append(
                f"neighbors of source {source.id} belong to veins {_listed(owners)},"
                f" not {_listed(needed)}"
            )
    return problems


def _pair_verdict(pair: Pair, problems: list[str]) -> Verdict:
    """Give the verdict on a pair."""
    value = f"step {pair.step}, at {pair.height:.2f} of the leaf length"
    if not problems and any(source.neighbors is None for source in pair.sides):
        return Verdict(None, value, NO_NEIGHBORS)
    return judged(not problems, value, "; ".join(problems))


def _not_paired(cast: Cast, first: SourceStory) -> Verdict:
    """Judge a first lateral source that is in no pair on the margin; a partner may come yet."""
    story = cast.story
    value = f"step {first.step}, at {first.y:.2f} of the leaf length"
    if any(first.id in pair.ids for pair in cast.pairs):
        return Verdict(False, value, f"source {first.id} and its mirror are not on the margin")
    what = f"source {first.id}, the first lateral one, has no mirror image"
    if story.last_time - first.time <= SEQUENCE.pair_time:
        return absent(story, what)
    return Verdict(False, value, what)


def _loops(cast: Cast, pair: Pair | None, loops: LoopPair | None, name: str) -> Verdict:
    """Judge whether a pair has closed its loops."""
    if pair is None:
        return undecided(f"there is no pair in the place of {name}")
    if loops is not None:
        return Verdict(True, f"steps {loops.left.step} and {loops.right.step}")
    closed = [loop for loop in cast.story.loops if loop.source in pair.ids]
    if {loop.source for loop in closed} == pair.ids:
        owners = " and ".join(_listed(loop.owners) for loop in closed)
        return Verdict(False, None, f"{name} closed loops of veins {owners} alone")
    return absent(cast.story, f"{name} closed no such loop on both sides")


def _listed(owners: set[int] | frozenset[int]) -> str:
    """List owners as people read them: by their source."""
    names = {SEED: "of the seed", MIDVEIN: "of the midvein"}
    words = [names.get(owner, f"of source {owner - 1}") for owner in sorted(owners)]
    return ", ".join(words) or "of none"
