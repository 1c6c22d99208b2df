"""The record of a run: a file that grows step by step, and everything that reads it.

The format is specified in docs/timeline-format.md.
"""

from vasc.timeline.frame import Frame
from vasc.timeline.layout import Motion, motion_of
from vasc.timeline.lineage import Lineage, SourceFate
from vasc.timeline.occurrences import Events
from vasc.timeline.reader import Timeline
from vasc.timeline.validation import validate
from vasc.timeline.writer import Recorder

__all__ = [
    "Events",
    "Frame",
    "Lineage",
    "Motion",
    "Recorder",
    "SourceFate",
    "Timeline",
    "motion_of",
    "validate",
]
