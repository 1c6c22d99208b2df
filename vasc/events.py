"""What happened in a step: a kind, a subject and an object, as rows of one table."""

from enum import IntEnum

from vasc.arrays import Column


class EventKind(IntEnum):
    """Kinds of events; the comment names subject and object."""

    SOURCE_PLACED = 0
    """(source, -1)"""
    SOURCE_TAGGED = 1
    """(source, node): the node is one of the veins the source waits for"""
    SOURCE_REMOVED = 2
    """(source, node): the nearest node when the source died"""
    VEIN_INITIATED = 3
    """(node, parent): the first node of a new vein, off a parent that had a child"""
    VEIN_JOINED = 4
    """(segment, source): two veins met where the source was"""
    VEIN_ENDED_BLINDLY = 5
    """(node, source): the vein reached its source, met no other and has no child"""
    LOOP_CLOSED = 6
    """(segment, source): the join closed a loop"""
    STALL_RESOLVED = 7
    """(parent, source): the pulls cancelled, the vein took the nearest source"""
    SEGMENT_REFINED = 8
    """(segment, node): the node halves the segment, which two new ones replace"""
    GROWTH_ENDED = 9
    """(-1, -1)"""
    RUN_FINISHED = 10
    """(reason, -1): see StopReason"""
    NODE_RETIRED = 11
    """(node, -1): refinement has cut the corner that the node was"""
    STRAND_EXTENDED = 12
    """(canal, node): the strand that differentiates along a canal has a new tip"""
    CANAL_RETARGETED = 13
    """(canal, node): the node a canal leads to, after refinement has replaced the former"""
    AREOLE_BORN = 14
    """(areole, segment): the segment closed it in tissue that was not enclosed"""
    AREOLE_SPLIT = 15
    """(areole, segment): the segment divides it in two, which are areoles of their own"""
    SOURCE_ENCLOSED = 16
    """(source, areole): the areole in which the source has appeared"""
    MESOPHYLL_EVENT = 17
    """(-1, -1): from now on developing veins end blindly"""
    CANALS_SETTLED = 18
    """(-1, -1): no wall of the tissue changes any more; strands differentiate"""
    CANALS_UNSETTLED = 19
    """(-1, -1): the time for the canals is over, though walls still change"""
    VORTEX_FORMED = 20
    """(cell, -1): more auxin circulates through the cell than all sources make"""


class StopReason(IntEnum):
    """Why a run ended by itself."""

    NO_SOURCES = 0
    """Growth and placement are over and no source is left."""
    NOTHING_PULLED = 1
    """Growth and placement are over; the sources left extend no vein."""
    LIVELOCK = 2
    """Veins are added again and again without coming nearer to any source."""
    STEP_LIMIT = 3
    """The config's last step was reached."""
    AT_REST = 4
    """All sources have been placed, and the tissue changes no more."""


EVENT_COLUMNS = {
    "step": Column("i4", "step of the event"),
    "kind": Column("i1", "kind of event, named in the file"),
    "subject": Column("i4", "row of what it happened to"),
    "object": Column("i4", "row of what took part, -1 if none"),
}
