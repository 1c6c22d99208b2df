"""The record of a run: a file that grows step by step, and everything that reads it.

The format is specified in docs/timeline-format.md.
"""

from vasc.timeline.frame import Frame
from vasc.timeline.genealogy import Genealogy
from vasc.timeline.layout import Motion, motion_of
from vasc.timeline.lineage import Lineage
from vasc.timeline.occurrences import Events
from vasc.timeline.reader import Timeline
from vasc.timeline.source_fates import Fate, SourceFate
from vasc.timeline.validation import validate
from vasc.timeline.writer import Recorder

__all__ = [
    "Events",
    "Fate",
    "Frame",
    "Genealogy",
    "Lineage",
    "Motion",
    "Recorder",
    "SourceFate",
    "Timeline",
    "motion_of",
    "validate",
]
