"""The first leaf of Arabidopsis: a recorded run held against the observed sequence of events."""

from vasc.validation.arabidopsis.cast import Cast, LoopPair, Pair
from vasc.validation.arabidopsis.criteria import CRITERIA, Criterion, Judged, judge
from vasc.validation.arabidopsis.reading import read_story
from vasc.validation.arabidopsis.report import SequenceReport, check_sequence
from vasc.validation.arabidopsis.story import Ending, LoopStory, SourceStory, Story

__all__ = [
    "CRITERIA",
    "Cast",
    "Criterion",
    "Ending",
    "Judged",
    "LoopPair",
    "LoopStory",
    "Pair",
    "SequenceReport",
    "SourceStory",
    "Story",
    "check_sequence",
    "judge",
    "read_story",
]
