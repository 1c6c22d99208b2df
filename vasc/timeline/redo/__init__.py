"""The redo log: a commit is whole in a log beside the file before the file is touched.

HDF5 writes into pages in memory. A commit appends the runs of bytes that have changed, as
one frame with a checksum, to ``RUN.h5-wal``; frames are applied to the file when nobody
reads it under a lock. Killed at any moment, the file and its log together hold every
commit. Nothing else in vasc writes HDF5 files.
"""

from vasc.timeline.redo.contents import log_of
from vasc.timeline.redo.disk import MovedError, sync_folder
from vasc.timeline.redo.durability import Durability
from vasc.timeline.redo.locks import BusyError, is_being_written
from vasc.timeline.redo.log import problem_of, refuse_foreign, refuse_strange, writer_of
from vasc.timeline.redo.pager import Pager, settle
from vasc.timeline.redo.signals import undisturbed
from vasc.timeline.redo.snapshot import Snapshot, steady

__all__ = [
    "BusyError",
    "Durability",
    "MovedError",
    "Pager",
    "Snapshot",
    "is_being_written",
    "log_of",
    "problem_of",
    "refuse_foreign",
    "refuse_strange",
    "settle",
    "steady",
    "sync_folder",
    "undisturbed",
    "writer_of",
]
