"""Verdicts: passed, failed, or not to be decided from what the run holds."""

from typing import NamedTuple

from vasc.validation.arabidopsis.story import Story

Value = float | int | str | None


class Verdict(NamedTuple):
    """What came of holding a run against one sentence.

    Parameters
    ----------
    passed : bool or None
        None if it cannot be decided.
    value : float, int, str or None
        What was found.
    reason : str
        Why it failed or cannot be decided; empty if it passed.
    """

    passed: bool | None
    value: Value
    reason: str = ""


def undecided(reason: str) -> Verdict:
    """Leave a question open."""
    return Verdict(None, None, reason)


def absent(story: Story, what: str) -> Verdict:
    """Judge what has not appeared: a failure once growth or the run is over, open before."""
    if story.is_over:
        return Verdict(False, None, f"{what} in the whole run")
    return undecided(f"{what} until step {story.last_step}, and the run is not over")


def judged(passed: bool, value: Value, reason: str) -> Verdict:
    """Give a verdict that tells the reason if it is a failure."""
    return Verdict(passed, value, "" if passed else reason)
