"""Criteria about what comes before what, and how often (C2, C10 to C13, C18 to C20)."""

from vasc.validation.arabidopsis.cast import Cast
from vasc.validation.arabidopsis.verdicts import Verdict, absent, judged, undecided
from vasc.validation.references import SEQUENCE

NO_LOOPS = "the loops it speaks of are not closed on both sides"
NO_PAIRS = "the pairs it speaks of have not both appeared"


def midvein_before_second_source(cast: Cast) -> Verdict:
    """C2: the tip source is drained before any other is born."""
    tip = cast.tip
    second = min((one.step for one in cast.story.sources[1:]), default=None)
    if tip is None:
        return undecided("there is no first source")
    if tip.drained_step is None:
        if second is None:
            return absent(cast.story, "the tip source is not drained")
        return Verdict(False, None, f"not drained when the second source appears at step {second}")
    return judged(
        second is None or tip.drained_step < second,
        f"drained at step {tip.drained_step}, second source at step {_or_none(second)}",
        "the second source appears first",
    )


def first_loops_before_second_pair(cast: Cast) -> Verdict:
    """C10: first loops closed, then the second pair born."""
    if cast.loop_1 is None or cast.pair_2 is None:
        return undecided(NO_LOOPS if cast.loop_1 is None else NO_PAIRS)
    return _before(cast.loop_1.step, cast.pair_2.step)


def upper_before_second_pair(cast: Cast) -> Verdict:
    """C10w: upper pair born, then the second pair born."""
    if cast.upper is None or cast.pair_2 is None:
        return undecided(NO_PAIRS)
    return _before(cast.upper.step, cast.pair_2.step)


def second_loops_before_third_pair(cast: Cast) -> Verdict:
    """C11: second loops closed, then the third pair born."""
    if cast.loop_2 is None or cast.pair_3 is None:
        return undecided(NO_LOOPS if cast.loop_2 is None else NO_PAIRS)
    return _before(cast.loop_2.step, cast.pair_3.step)


def minor_veins_after_second_loops(cast: Cast) -> Verdict:
    """C12: second loops closed, then the first source inside a first loop."""
    if cast.loop_1 is None or cast.loop_2 is None:
        return undecided(NO_LOOPS)
    inside = cast.loop_1.first_source(cast.story)
    if inside is None:
        return undecided("no source has appeared inside a first loop")
    return _before(cast.loop_2.step, inside.step)


def minor_veins_from_tip_to_base(cast: Cast) -> Verdict:
    """C13: first loops filled soon after the third are closed, and not after the second are."""
    story = cast.story
    if cast.loop_1 is None or cast.loop_2 is None or cast.loop_3 is None:
        return undecided(NO_LOOPS)
    latest = cast.loop_3.time + SEQUENCE.minor_delay
    in_first, in_second = cast.loop_1.first_source(story), cast.loop_2.first_source(story)
    if in_first is None:
        if story.last_time > latest:
            return Verdict(False, None, "no source has appeared inside a first loop")
        return absent(story, "no source inside a first loop")
    second = _or_none(None if in_second is None else in_second.step)
    value = f"first loops step {in_first.step}, second step {second}"
    if in_first.time > latest:
        delay = in_first.time - cast.loop_3.time
        return Verdict(False, value, f"{delay:g} steps after the third loops are closed")
    is_first = in_second is None or in_first.time <= in_second.time
    return judged(is_first, value, "a second loop is filled before the first")


def no_other_source_on_the_margin(cast: Cast) -> Verdict:
    """C18: only the tip and the pairs until the third loops are closed."""
    if cast.loop_3 is None:
        return undecided(NO_LOOPS)
    known = {cast.story.sources[0].id}
    for pair in (cast.pair_1, cast.upper, cast.pair_2, cast.pair_3):
        known |= set() if pair is None else pair.ids
    others = [
        one
        for one in cast.story.sources
        if one.is_on_margin and one.step < cast.loop_3.step and one.id not in known
    ]
    first = others[0] if others else None
    reason = "" if first is None else f"source {first.id} at step {first.step}, {first.y:.2f} up"
    return judged(not others, len(others), reason)


def every_source_mirrored(cast: Cast) -> Verdict:
    """C19: no lateral source without a partner until the third loops are closed."""
    paired = {each for pair in cast.pairs for each in pair.ids}
    last = cast.story.last_step if cast.loop_3 is None else cast.loop_3.step
    # a partner may be born yet in the last steps of a run that is not over
    seen = cast.story.last_time - (0.0 if cast.story.is_over else SEQUENCE.pair_time)
    alone = [
        one
        for one in cast.story.sources[1:]
        if one.side and one.step <= last and one.time <= seen and one.id not in paired
    ]
    if not alone and cast.loop_3 is None:
        return undecided(NO_LOOPS)
    reason = f"source {alone[0].id} at step {alone[0].step} has none" if alone else ""
    return judged(not alone, len(alone), reason)


def blind_ends_after_mesophyll(cast: Cast) -> Verdict:
    """C20: no blind end before the event, some after it, and no join after it."""
    story, ending = cast.story, cast.story.ending
    if ending.step is None:
        return undecided("no event of mesophyll differentiation is recorded")
    value = f"{ending.blind_after} blind ends and {ending.joins_after} joins after it"
    if ending.blind_before:
        return Verdict(False, value, f"{ending.blind_before} blind ends before it")
    if ending.joins_after:
        return Verdict(False, value, f"{ending.joins_after} joins after it")
    if not ending.blind_after:
        return absent(story, "no blind end")
    return Verdict(True, value)


def _before(first: int, second: int) -> Verdict:
    """Judge whether one step is before another."""
    reason = "both in one step" if first == second else "the other way round"
    return judged(first < second, f"step {first}, then step {second}", reason)


def _or_none(step: int | None) -> str:
    """Write a step, or that there is none."""
    return "none" if step is None else str(step)
