"""What the sequence checker says: events, verdicts, features and symmetry, as one report."""

from collections.abc import Iterator
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from vasc.timeline import Timeline
from vasc.validation.arabidopsis.cast import Cast, LoopPair
from vasc.validation.arabidopsis.criteria import Judged, judge
from vasc.validation.arabidopsis.features import (
    Symmetry,
    measure_features,
    measure_symmetry,
    measure_texts,
    n_loop_pairs,
)
from vasc.validation.arabidopsis.reading import node_owners, read_story
from vasc.validation.arabidopsis.verdicts import Verdict
from vasc.validation.references import CITATIONS, FEATURES, OBSERVED_SEQUENCE


@dataclass(frozen=True)
class SequenceReport:
    """A run held against the observed sequence of the first leaf of Arabidopsis.

    Parameters
    ----------
    cast : Cast
        The story of the run, and who is who in it.
    criteria : tuple of Judged
        The criteria with their verdicts.
    events : list of dict
        See :func:`sequence_events`.
    features : dict of str to Verdict
        Features (a) to (d); they do not decide whether the run passes.
    symmetry : Symmetry
        Distance from the mirror image at the last step, in D.
    run : dict
        What run it is.
    """

    cast: Cast
    criteria: tuple[Judged, ...]
    events: list[dict[str, Any]]
    features: dict[str, Verdict]
    symmetry: Symmetry
    run: dict[str, Any]

    @property
    def failures(self) -> list[str]:
        """Ids of the criteria that the run fails."""
        return [row.criterion.id for row in self.criteria if row.verdict.passed is False]

    @property
    def undecided(self) -> list[str]:
        """Ids of the criteria that cannot be decided."""
        return [row.criterion.id for row in self.criteria if row.verdict.passed is None]

    @property
    def passed(self) -> bool:
        """No criterion fails, and one at least is decided."""
        return not self.failures and len(self.undecided) < len(self.criteria)

    @property
    def order_ok(self) -> bool | None:
        """The events came in the observed order; None if one that is missing may yet come."""
        verdicts = [row.verdict.passed for row in self.criteria if row.criterion.is_order]
        if False in verdicts:
            return False
        return None if None in verdicts else True

    def as_json(self) -> dict[str, Any]:
        """Give the report as JSON values."""
        texts = measure_texts()
        return {
            "run": self.run,
            "pass": self.passed,
            "failures": self.failures,
            "undecided": self.undecided,
            "order_ok": self.order_ok,
            "loops": n_loop_pairs(self.cast),
            "symmetry": self.symmetry.largest,
            "features": {name: verdict.passed for name, verdict in self.features.items()},
            "events": self.events,
            "criteria": [row.as_json() for row in self.criteria],
            "feature_details": [
                {"id": name, "text": FEATURES[name], "measure": texts[name]} | verdict._asdict()
                for name, verdict in self.features.items()
            ],
            "loop_pairs": [dict(row) for row in _loop_rows(self.cast)],
            "symmetry_details": self.symmetry._asdict(),
            "final_areas": _final(self.cast),
            "observed": [asdict(one) for one in OBSERVED_SEQUENCE],
            "citations": CITATIONS,
        }


def check_sequence(run: str | Path | Timeline) -> SequenceReport:
    """Hold a recorded leaf against the sequence observed in the first leaf of Arabidopsis.

    Only the record is read, so that any leaf with a midvein can be judged,
    whatever model and growth made it. What cannot be decided says so.

    Parameters
    ----------
    run : path or Timeline
        A recorded run; one that is open already stays open.

    Returns
    -------
    SequenceReport
        Verdicts on criteria C1 to C20, events, features and symmetry.

    Raises
    ------
    VascError
        If no source was placed.
    TimelineError
        If the file is no timeline, or cannot be read.
    """
    if isinstance(run, Timeline):
        return _checked(run)
    with Timeline(run) as timeline:
        return _checked(timeline)


def _checked(timeline: Timeline) -> SequenceReport:
    """Check an open timeline."""
    cast = Cast(read_story(timeline))
    return SequenceReport(
        cast=cast,
        criteria=judge(cast),
        events=sequence_events(cast),
        features=measure_features(timeline, cast, node_owners(timeline)),
        symmetry=measure_symmetry(timeline.frame()),
        run={
            "file": timeline.path.name,
            "title": timeline.config.get("title"),
            "model": timeline.model,
            "growth": timeline.growth,
            "steps": timeline.last_step,
            "time": cast.story.last_time,
            "complete": timeline.is_complete,
        },
    )


def sequence_events(cast: Cast) -> list[dict[str, Any]]:
    """Give the events of the sequence that occurred, in the order of time.

    Parameters
    ----------
    cast : Cast
        Who is who.

    Returns
    -------
    list of dict
        ``name, step, time, leaf_length, sources`` and ``height``, the place of a pair
        in leaf lengths from the base; None where it has none.
    """
    rows = [*_births(cast), *_loop_events(cast), *_endings(cast)]
    return sorted(rows, key=lambda row: row["step"])


def _births(cast: Cast) -> Iterator[dict[str, Any]]:
    """Give the births of the actors, and what follows from them without a loop."""
    tip = cast.tip
    if tip is not None:
        yield _row(cast, "tip_source", tip.step, tip.time, [tip.id], tip.y)
        if tip.drained_step is not None and tip.drained_time is not None:
            yield _row(cast, "midvein", tip.drained_step, tip.drained_time, [tip.id])
    for name, pair in (
        ("pair_1", cast.pair_1),
        ("upper_pair", cast.upper),
        ("pair_2", cast.pair_2),
        ("pair_3", cast.pair_3),
    ):
        if pair is not None:
            yield _row(cast, name, pair.step, pair.time, sorted(pair.ids), pair.height)
    lower = () if cast.pair_1 is None else cast.pair_1.sides
    ends = [(one.drained_step, one.drained_time) for one in lower if one.drained_step is not None]
    if len(ends) == 2:
        step, time = max(ends, key=lambda end: end[0])
        yield _row(cast, "lower_halves", step, time, sorted(one.id for one in lower))


def _loop_events(cast: Cast) -> Iterator[dict[str, Any]]:
    """Give the closings of loops, and the first sources inside them."""
    for number, loops in enumerate((cast.loop_1, cast.loop_2, cast.loop_3), start=1):
        if loops is None:
            continue
        ids = [loop.source for loop in loops.sides]
        yield _row(cast, f"loop_{number}", loops.step, loops.time, ids)
        inside = loops.first_source(cast.story)
        if inside is not None:
            name = f"minor_in_loop_{number}"
            yield _row(cast, name, inside.step, inside.time, [inside.id], inside.y)


def _endings(cast: Cast) -> Iterator[dict[str, Any]]:
    """Give the events that end growth and joining."""
    story, ending = cast.story, cast.story.ending
    if ending.step is not None and ending.time is not None:
        yield _row(cast, "mesophyll_event", ending.step, ending.time, [])
    if ending.first_blind is not None:
        step, time = ending.first_blind, ending.first_blind_time
        yield _row(cast, "first_free_end", step, time, [])
    if story.growth_ended is not None:
        yield _row(cast, "growth_ended", story.growth_ended, story.growth_ended_time, [])


def _row(
    cast: Cast,
    name: str,
    step: int,
    time: float | None,
    sources: list[int],
    height: float | None = None,
) -> dict[str, Any]:
    """Give one event."""
    return {
        "name": name,
        "step": step,
        "time": time,
        "leaf_length": cast.story.lengths(step),
        "sources": sources,
        "height": height,
    }


def _loop_rows(cast: Cast) -> Iterator[dict[str, Any]]:
    """Give the loops of the sequence with their areas at closing and in the end."""
    for number, loops in enumerate((cast.loop_1, cast.loop_2, cast.loop_3), start=1):
        if loops is not None:
            yield {"loop": number, "step": loops.step} | _areas(loops, cast.story.last_step)


def _areas(loops: LoopPair, last_step: int) -> dict[str, list[float]]:
    """Give the areas of both sides, left first, in D^2."""
    return {
        "area_closed": [loop.areas[loop.step] for loop in loops.sides],
        "area_final": [loop.areas[last_step] for loop in loops.sides],
    }


def _final(cast: Cast) -> dict[str, Any]:
    """Say at which step the areas of the end were measured."""
    story = cast.story
    grown = story.growth_ended is not None
    ended = f"growth ended at step {story.growth_ended}"
    note = ended if grown else "the file does not say that growth has ended by then"
    return {"step": story.last_step, "time": story.last_time, "grown": grown, "note": note}
