"""The criteria of the sequence as a table: a sentence, a threshold, where it is from, a verdict."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

from vasc.validation.arabidopsis import events, relations
from vasc.validation.arabidopsis.cast import Cast
from vasc.validation.arabidopsis.verdicts import Value, Verdict
from vasc.validation.references import OURS, SEQUENCE, THESIS, Basis


class Criterion(NamedTuple):
    """One row of the table.

    Parameters
    ----------
    id : str
        ``C1`` to ``C20``, and ``C10w``.
    text : str
        What has to be true.
    threshold : str
        The number or the relation in it.
    basis : str
        ``thesis`` if the words of the thesis say it, ``ours`` if the number is ours.
    judge : callable
        Gives the verdict on a cast.
    is_order : bool
        It speaks of what comes before what.
    """

    id: str
    text: str
    threshold: str
    basis: Basis
    judge: Callable[[Cast], Verdict]
    is_order: bool = False


@dataclass(frozen=True)
class Judged:
    """A criterion and its verdict.

    Parameters
    ----------
    criterion : Criterion
        The row.
    verdict : Verdict
        Passed, failed or not decided, with value and reason.
    """

    criterion: Criterion
    verdict: Verdict

    def as_json(self) -> dict[str, Value | bool]:
        """Give the row as JSON values."""
        row, verdict = self.criterion, self.verdict
        return {
            "id": row.id,
            "text": row.text,
            "threshold": row.threshold,
            "threshold_from": row.basis,
            "value": verdict.value,
            "passed": verdict.passed,
            "reason": verdict.reason,
        }


_LOW, _HIGH = SEQUENCE.half_way
_LEAST, _MOST = SEQUENCE.third_final_ratio
_PAIR = f"born within {SEQUENCE.pair_time:g} steps, mirrored within {SEQUENCE.mirrored:.0%}"

CRITERIA = (
    Criterion(
        "C1",
        "The first source appears at the tip; its only relative neighbor is the seed.",
        f"within {SEQUENCE.tip:.0%} of the leaf length",
        OURS,
        relations.tip_is_first,
    ),
    Criterion(
        "C2",
        "The tip source is drained, so that the midvein is there, before a second source appears.",
        "before",
        THESIS,
        events.midvein_before_second_source,
        is_order=True,
    ),
    Criterion(
        "C3",
        "The first lateral sources are a mirrored pair on the margin, half-way between tip and"
        " base, whose relative neighbors are on the midvein alone: lower halves, no loop yet.",
        f"{_LOW:g} to {_HIGH:g} of the leaf length; {_PAIR}",
        OURS,
        relations.first_pair,
    ),
    Criterion(
        "C4",
        "A mirrored pair on the margin follows nearer the tip; midvein and the first pair's veins"
        " are among its relative neighbors.",
        _PAIR,
        OURS,
        relations.upper_pair,
    ),
    Criterion(
        "C5",
        "The veins of that pair close the first loops on both sides, with midvein and the first"
        " pair's veins.",
        "both sides",
        THESIS,
        relations.first_loops,
    ),
    Criterion(
        "C6",
        "A second mirrored pair on the margin appears nearer the base than the first; its relative"
        " neighbors are midvein and the first pair's veins.",
        _PAIR,
        OURS,
        relations.second_pair,
    ),
    Criterion(
        "C7",
        "The second loops are closed on both sides, with midvein and first loops.",
        "both sides",
        THESIS,
        relations.second_loops,
    ),
    Criterion(
        "C8",
        "A third mirrored pair on the margin appears nearer the base than the second; its relative"
        " neighbors are midvein and the second pair's veins.",
        _PAIR,
        OURS,
        relations.third_pair,
    ),
    Criterion(
        "C9",
        "The third loops are closed on both sides, with midvein and second loops.",
        "both sides",
        THESIS,
        relations.third_loops,
    ),
    Criterion(
        "C10",
        "The first loops are closed before the second pair appears.",
        "before",
        THESIS,
        events.first_loops_before_second_pair,
        is_order=True,
    ),
    Criterion(
        "C10w",
        "The upper pair appears before the second pair does (a weaker form of C10).",
        "before",
        THESIS,
        events.upper_before_second_pair,
        is_order=True,
    ),
    Criterion(
        "C11",
        "The second loops are closed before the third pair appears.",
        "before",
        THESIS,
        events.second_loops_before_third_pair,
        is_order=True,
    ),
    Criterion(
        "C12",
        "The first source inside a first loop appears after the second loops are closed.",
        "after",
        THESIS,
        events.minor_veins_after_second_loops,
        is_order=True,
    ),
    Criterion(
        "C13",
        "The first source inside a first loop appears soon after the third loops are closed, if not"
        " before, and not later than the"
        " first source inside a second loop.",
        f"at most {SEQUENCE.minor_delay:g} steps after",
        OURS,
        events.minor_veins_from_tip_to_base,
        is_order=True,
    ),
    Criterion(
        "C14",
        "The second loops enclose less than the first when they are closed.",
        f"area ratio below {SEQUENCE.formed_ratio:g}",
        THESIS,
        relations.second_smaller_when_formed,
    ),
    Criterion(
        "C15",
        "In the end the second loops enclose more than the first.",
        f"area ratio above {SEQUENCE.formed_ratio:g}",
        THESIS,
        relations.second_larger_in_the_end,
    ),
    Criterion(
        "C16",
        "The third loops enclose much less than the second when they are closed.",
        f"area ratio below {SEQUENCE.third_formed_ratio:g}",
        OURS,
        relations.third_smaller_when_formed,
    ),
    Criterion(
        "C17",
        "In the end the third loops enclose about as much as the second.",
        f"area ratio {_LEAST:g} to {_MOST:g}",
        OURS,
        relations.third_alike_in_the_end,
    ),
    Criterion(
        "C18",
        "No other source appears on the margin before the third loops are closed.",
        "none",
        THESIS,
        events.no_other_source_on_the_margin,
    ),
    Criterion(
        "C19",
        "Every lateral source until the third loops are closed has a mirror image.",
        _PAIR,
        OURS,
        events.every_source_mirrored,
    ),
    Criterion(
        "C20",
        "Veins end blindly only after mesophyll differentiates, and some do; none join after it.",
        "none before, some after",
        THESIS,
        events.blind_ends_after_mesophyll,
    ),
)
"""All criteria, in order."""


def judge(cast: Cast) -> tuple[Judged, ...]:
    """Give the verdicts on a story, a row a criterion.

    Parameters
    ----------
    cast : Cast
        Who is who in the story.
    """
    return tuple(Judged(criterion, criterion.judge(cast)) for criterion in CRITERIA)
