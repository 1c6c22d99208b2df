import numpy as np
import pytest

from vasc.states import FIRST, TRANSITIONS, CanalState, Kind, NodeState, SourceState
from vasc.states import check_transitions as check

STATES = {Kind.NODE: NodeState, Kind.SOURCE: SourceState, Kind.CANAL: CanalState}


@pytest.mark.parametrize("kind", Kind, ids=lambda kind: kind.name)
def test_exactly_the_listed_changes_are_legal(kind):
    for before in STATES[kind]:
        for after in STATES[kind]:
            if (before, after) in TRANSITIONS[kind]:
                check(kind, before, after)
            else:
                with pytest.raises(AssertionError, match=f"no {kind.name.lower()} may change"):
                    check(kind, before, after)


@pytest.mark.parametrize("kind", Kind, ids=lambda kind: kind.name)
def test_every_state_can_be_reached_from_the_first(kind):
    reached = {FIRST[kind]}
    for _ in STATES[kind]:
        reached |= {after for before, after in TRANSITIONS[kind] if before in reached}
    assert reached == set(STATES[kind])


def test_many_changes_are_checked_at_once():
    before = np.array([0, 0, 1])
    check(Kind.CANAL, before, [1, 1, 2])
    check(Kind.CANAL, [], [])
    with pytest.raises(AssertionError, match="from state 0 to 2"):
        check(Kind.CANAL, before, CanalState.INBOUND)
