"""Small configs with given sources, and the comparison of their runs with the slow leaf."""

import numpy as np

from vasc.events import EventKind, StopReason
from vasc.models import ClosedVenation, OpenVenation
from vasc.network import SegmentKind

KINDS = {"open": OpenVenation, "closed": ClosedVenation}


def config(kind, points, births=None, **tables):
    """A config with given sources on a round blade 14 D long."""
    placement = {"kind": "given", "points": points}
    if births is not None:
        placement["births"] = births
    return {
        "kind": kind,
        "domain": {"shape": "orbicular", "length": 14.0},
        "placement": placement,
        "arrival": {"kill_distance": 1.2},
        **tables,
    }


def model_of(tables):
    """The model of a config."""
    return KINDS[tables["kind"]].model_validate(tables).model()


def events(state, kind):
    """Step, subject and object of all events of a kind."""
    rows = state.rows("events", "kind") == kind
    columns = [state.rows("events", name)[rows].tolist() for name in ("step", "subject", "object")]
    return list(zip(*columns, strict=True))


def assert_same(state, leaf):
    """All that a state records equals the slow leaf, positions to the last bit."""
    np.testing.assert_array_equal(state.rows("nodes", "material"), np.array(leaf.nodes))
    assert_same_veins(state, leaf)


def assert_same_veins(state, leaf):
    """All that a state records equals the slow leaf, wherever it is."""
    assert state.step == leaf.step
    assert state.rows("nodes", "parent").tolist() == leaf.parents
    assert state.rows("nodes", "birth").tolist() == leaf.births
    assert state.rows("nodes", "source").tolist() == leaf.causes
    assert state.rows("segments", "nodes").tolist() == [list(pair) for pair in leaf.segments]
    is_join = state.rows("segments", "kind") == SegmentKind.JOIN
    joins = [tuple(pair) for pair in state.rows("segments", "nodes")[is_join].tolist()]
    assert joins == leaf.joins
    assert events(state, EventKind.SOURCE_REMOVED) == leaf.removed
    assert events(state, EventKind.SOURCE_TAGGED) == leaf.tagged
    for kind, expected in (
        (EventKind.VEIN_INITIATED, leaf.initiated),
        (EventKind.VEIN_ENDED_BLINDLY, leaf.ended),
        (EventKind.LOOP_CLOSED, leaf.loops),
        (EventKind.SEGMENT_REFINED, leaf.refined),
    ):
        assert [tuple(row[1:]) for row in events(state, kind)] == expected
    assert len(events(state, EventKind.STALL_RESOLVED)) == leaf.n_stalled
    assert sorted(state.live.tolist()) == sorted(leaf.sources)
    reasons = [StopReason(reason).name for _, reason, _ in events(state, EventKind.RUN_FINISHED)]
    assert [reason for reason in reasons if reason != "STEP_LIMIT"] == [leaf.reason] * bool(
        leaf.reason
    )
