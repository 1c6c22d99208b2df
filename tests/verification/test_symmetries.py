"""What no rule depends on: the unit of length, left and right, and what is far away."""

import numpy as np
import pytest

from vasc.models import ClosedVenation, OpenVenation
from vasc.simulation import simulate
from vasc.streams import Streams

KINDS = {
    "open": (OpenVenation, "nearest"),
    "relative": (ClosedVenation, "relative"),
    "urquhart": (ClosedVenation, "urquhart"),
}
RECORDS = (
    ("nodes", "parent"),
    ("nodes", "birth"),
    ("nodes", "source"),
    ("segments", "nodes"),
    ("segments", "kind"),
    ("perceived", "source"),
    ("perceived", "node"),
    ("events", "kind"),
    ("events", "subject"),
    ("events", "object"),
)


def leaf(kind, points, *, unit=1.0, growth=None, **domain):
    """The last state of a run with given sources on a round blade; lengths times a unit."""
    venation, perception = KINDS[kind]
    tables = {
        "domain": {"shape": "orbicular", "length": 80.0 * unit, **domain},
        "placement": {"kind": "given", "points": points * unit},
        "perception": {"kind": perception},
        "extension": {"segment_length": unit},
        "arrival": {"kill_distance": 1.5 * unit},
        "record": {"perceived": "nodes"},
    }
    if growth:
        final, increase = growth
        tables["growth"] = {
            "kind": "isogonic", "final_length": final * unit, "length_per_step": increase * unit
        }  # fmt: skip
        tables["refinement"] = {"kind": "subdivision", "longest": 2.0 * unit}
    *_, last = simulate(venation.model_validate(tables).model(), Streams(1))
    return last


def sources(seed, n_sources=120):
    """Places in a round blade 80 D long."""
    points = np.random.default_rng(seed).uniform(-40.0, 40.0, (4 * n_sources, 2))
    return points[np.hypot(*points.T) < 38.0][:n_sources] + np.array([0.0, 40.0])


def assert_same_records(one, other):
    """Two runs went the same way, step by step."""
    assert one.step == other.step
    for table, column in RECORDS:
        np.testing.assert_array_equal(one.rows(table, column), other.rows(table, column))


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("growth", [None, (130.0, 0.7)])
def test_the_unit_of_length_does_not_matter(kind, growth):
    points = sources(1)
    one, larger = leaf(kind, points, growth=growth), leaf(kind, points, unit=4.0, growth=growth)
    assert one.n_rows("nodes") > 500
    assert_same_records(one, larger)
    # a power of two changes no digit
    np.testing.assert_array_equal(
        4.0 * one.rows("nodes", "position"), larger.rows("nodes", "position")
    )


@pytest.mark.parametrize("kind", KINDS)
def test_a_mirrored_blade_has_mirrored_veins(kind):
    points = sources(2)
    mirror = np.array([-1.0, 1.0])
    one, other = leaf(kind, points), leaf(kind, points * mirror)
    assert one.n_rows("nodes") > 500
    assert_same_records(one, other)
    np.testing.assert_array_equal(
        one.rows("nodes", "position") * mirror, other.rows("nodes", "position")
    )


@pytest.mark.parametrize("kind", KINDS)
def test_the_order_of_sources_changes_only_their_names(kind):
    points = sources(3, 60)
    order = np.random.default_rng(0).permutation(len(points))
    one, other = leaf(kind, points), leaf(kind, points[order])
    # sums of unit vectors are rounded otherwise in another order
    np.testing.assert_allclose(
        one.rows("nodes", "position"), other.rows("nodes", "position"), atol=1e-9
    )
    np.testing.assert_array_equal(one.rows("segments", "nodes").shape,
                                  other.rows("segments", "nodes").shape)  # fmt: skip
    causes = one.rows("nodes", "source"), other.rows("nodes", "source")
    is_new = causes[0] >= 0
    np.testing.assert_array_equal(causes[0][is_new], order[causes[1][is_new]])


@pytest.mark.parametrize("kind", KINDS)
def test_the_search_grid_does_not_matter(kind):
    # a larger blade has another box and other cells, and the sources stay where they are
    points = sources(4)
    one = leaf(kind, points)
    other = leaf(kind, points, length=333.0)
    assert_same_records(one, other)
    np.testing.assert_array_equal(one.rows("nodes", "position"), other.rows("nodes", "position"))
