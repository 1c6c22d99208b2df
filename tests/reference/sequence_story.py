"""The story of a leaf that goes through the observed sequence, and ways to spoil it."""

import json
from dataclasses import replace
from pathlib import Path

from vasc.validation.arabidopsis import Ending, LoopStory, SourceStory, Story

RECORD = json.loads((Path(__file__).parents[1] / "data" / "arabidopsis_sequence.json").read_text())
LOOPS = {4: "1", 5: "1", 6: "2", 7: "2", 8: "3", 9: "3"}
"""Which loop the veins of a source close, by the source's id in the record."""


def control_story():
    """Build the story that the record tells."""
    events = RECORD["events"]
    inside = {10: 4, 11: 5, 16: 6, 17: 7}
    sources = tuple(_source(event, events) for event in events if event["event"] == "source")
    loops = []
    for event in events:
        if event["event"] == "connect" and event["id"] in LOOPS:
            first = next((one - 1 for one, loop in inside.items() if loop == event["id"]), None)
            loops.append(
                LoopStory(
                    source=event["id"] - 1,
                    step=event["step"],
                    time=float(event["step"]),
                    owners=frozenset(event["cycle_owners"]),
                    areas=_areas(LOOPS[event["id"]]),
                    first_source=first,
                )
            )
    last, event_step = RECORD["last_step"], RECORD["mesophyll_event"]
    return Story(
        sources=sources,
        loops=tuple(loops),
        ending=Ending(event_step, float(event_step), 0, RECORD["blind"], RECORD["joins"], 0),
        last_step=last,
        last_time=float(last),
        is_over=True,
        growth_ended=RECORD["growth_ended"],
        growth_ended_time=float(RECORD["growth_ended"]),
        heights=lambda source, step: sources[source].y,
        lengths=lambda step: 8.0 + step,
    )


def _source(event, events):
    """Build one source; ids of the record begin with 1, rows with 0."""
    length = event["y"] / event["rel"]
    drained = next(
        each["step"] for each in events if each["event"] == "drained" and each["id"] == event["id"]
    )
    return SourceStory(
        id=event["id"] - 1,
        step=event["step"],
        time=float(event["step"]),
        x=event["x"] / length,
        y=event["rel"],
        leaf_length=length,
        is_on_margin=event["margin"],
        neighbors=frozenset(event["rn_owner"]),
        drained_step=drained,
        drained_time=float(drained),
    )


def _areas(loop):
    """Give the areas of a loop at the closings since, and in the end."""
    closed = {"1": 133.4, "2": 111.2, "3": 115.9}
    ratios, last = RECORD["area_ratios"], RECORD["last_step"]
    second = 5000.0 * ratios["loop_2_over_1_final"]
    return {
        "1": {133: closed["1"], 162: closed["2"] / ratios["loop_2_over_1_closed"], last: 5000.0},
        "2": {162: closed["2"], 206: closed["3"] / ratios["loop_3_over_2_closed"], last: second},
        "3": {206: closed["3"], last: second * ratios["loop_3_over_2_final"]},
    }[loop]


def with_sources(story, ids, **changes):
    """Change sources; those of the record, less one."""
    sources = tuple(replace(one, **changes) if one.id in ids else one for one in story.sources)
    return replace(story, sources=sources, heights=lambda source, step: sources[source].y)


def with_loops(story, ids, **changes):
    """Change the loops that the veins of some sources closed."""
    loops = tuple(replace(one, **changes) if one.source in ids else one for one in story.loops)
    return replace(story, loops=loops)


def with_areas(story, ids, step, factor):
    """Change areas at a step."""
    loops = tuple(
        replace(one, areas=dict(one.areas) | {step: one.areas[step] * factor})
        if one.source in ids
        else one
        for one in story.loops
    )
    return replace(story, loops=loops)


def with_one_more(story, **values):
    """Add a source at the end."""
    more = replace(story.sources[-1], id=len(story.sources), **values)
    sources = (*story.sources, more)
    return replace(story, sources=sources, heights=lambda source, step: sources[source].y)


def with_half_long_steps(story):
    """Tell the same story in steps half as long."""
    sources = tuple(
        replace(one, step=2 * one.step, drained_step=2 * one.drained_step) for one in story.sources
    )
    loops = tuple(
        replace(
            one,
            step=2 * one.step,
            areas={2 * step: area for step, area in one.areas.items()},
        )
        for one in story.loops
    )
    return replace(story, sources=sources, loops=loops, last_step=2 * story.last_step)
