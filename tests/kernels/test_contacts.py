"""Segments that cross, touch or overlap, against shapely on every pair."""

import numpy as np
import shapely
from hypothesis import given
from hypothesis import strategies as st

from vasc.kernels.contacts import segment_contacts


def contacts_by_pairs(points, segments):
    lines = shapely.linestrings(points[segments])
    found = set()
    for i in range(len(segments)):
        for j in range(i + 1, len(segments)):
            shared = set(segments[i].tolist()) & set(segments[j].tolist())
            meeting = shapely.intersection(lines[i], lines[j])
            if (not shared and not meeting.is_empty) or meeting.length > 0:
                found.add((i, j))
    return found


@given(st.integers(0, 2**32 - 1), st.booleans(), st.sampled_from([0.05, 0.3, 5.0]))
def test_equals_all_pairs(seed, is_on_grid, side):
    rng = np.random.default_rng(seed)
    # on a coarse grid many segments touch, overlap or share a line
    points = rng.integers(0, 5, (14, 2)) / 4.0 if is_on_grid else rng.random((14, 2))
    points = np.unique(points, axis=0)
    segments = np.array(
        [rng.choice(len(points), 2, replace=False) for _ in range(12)], dtype=np.int32
    )
    segments = np.unique(np.sort(segments, axis=1), axis=0)
    found = segment_contacts(points, segments, side)
    assert {tuple(sorted(pair)) for pair in found.tolist()} == contacts_by_pairs(points, segments)
    assert len({tuple(pair) for pair in found.tolist()}) == len(found)
