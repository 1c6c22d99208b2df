"""The record of a run: a file that grows step by step, and everything that reads it.

The format is specified in docs/timeline-format.md.
"""

from vasc.timeline.frame import Frame
from vasc.timeline.lineage import Lineage, SourceFate
from vasc.timeline.reader import Events, Timeline
from vasc.timeline.validation import validate
from vasc.timeline.writer import Recorder

__all__ = ["Events", "Frame", "Lineage", "Recorder", "SourceFate", "Timeline", "validate"]
