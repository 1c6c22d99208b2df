"""Laws that statistics of any network obey: Euler's formula, areas, turning and scaling."""

from functools import cache
from pathlib import Path

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st
from reference.drawn_networks import binary_tree, honeycomb, pinnate_leaf
from reference.leaves import SMALL, leaf
from reference.networks import grid, grown_leaf, network, random_planar, random_tree

from vasc.analysis import find_areoles, find_sections, network_statistics
from vasc.analysis.statistics import POWERS
from vasc.analysis.vein_distance import enclosed_region
from vasc.faces import face_walks
from vasc.models import AreoleVenation, ClosedVenation, OpenVenation
from vasc.networks_in import read_network
from vasc.real_network import RealNetwork
from vasc.simulation import simulate
from vasc.streams import Streams

seeds = st.integers(0, 2**32 - 1)
DALBERGIA = Path(__file__).parent.parent / "data" / "dalbergia" / "dalbergia.csv"
MODELS = {"open": OpenVenation, "closed": ClosedVenation, "areole": AreoleVenation}
BY_PLACES = ("distance", "density_x_distance")
"""Numbers from places in a box that does not turn with the leaf."""


def tangle(seed):
    """Veins that cross each other everywhere."""
    rng = np.random.default_rng(seed)
    return network(rng.random((12, 2)), random_tree(rng, 12).segments)


@cache
def grown(kind):
    """The network of a small leaf of a model, on a blade that deforms."""
    tables = leaf(kind, SMALL, 6.0, until=100)
    return list(simulate(MODELS[kind].model_validate(tables).model(), Streams(1), max_steps=200))[
        -1
    ].network


def named(name):
    """A network by name."""
    made = {
        "grid": lambda: grid(5, 4),
        "honeycomb": lambda: honeycomb(6, 6),
        "tree": lambda: binary_tree(5),
        "pinnate": lambda: pinnate_leaf()[0],
        "joined": lambda: grown_leaf(30.0, 40, np.random.default_rng(3))[1],
        "real": lambda: read_network(DALBERGIA).network,
    }
    return made[name]() if name in made else grown(name)


def check_euler(net):
    """V - E + F = 1 + C, with the outside as a face, in what is drawn."""
    drawing = find_sections(net).drawing
    used = np.unique(drawing.segments)
    rows = np.searchsorted(used, drawing.segments)
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    links = coo_array((np.ones(len(rows)), rows.T), shape=(len(used), len(used)))
    n_pieces = connected_components(links)[0]
    n_faces = 1 + find_areoles(net).n_areoles
    assert len(used) - len(drawing.segments) + n_faces == 1 + n_pieces
    # and by the walks: each piece has an outside of its own, all of which are one face
    if len(rows):
        n_walks = len(face_walks(drawing).areas)
        assert len(used) - len(rows) + n_walks - n_pieces + 1 == 1 + n_pieces


NAMES = ["grid", "honeycomb", "tree", "pinnate", "joined", "real", *MODELS]


@pytest.mark.parametrize("name", NAMES)
def test_euler_on_leaves(name):
    check_euler(named(name))


@given(seeds, st.floats(0.05, 1.0))
def test_euler_on_random_networks(seed, share):
    check_euler(random_planar(np.random.default_rng(seed), 50, share))


@given(seeds)
def test_euler_where_veins_cross(seed):
    check_euler(tangle(seed))


def check_areas(net):
    """Areas of areoles add up to what veins enclose, measured by another library."""
    sections = find_sections(net)
    lines = shapely.linestrings(sections.drawing.points[sections.drawing.segments])
    faces = shapely.get_parts(shapely.polygonize(lines))
    enclosed = shapely.union_all(faces).area
    assert find_areoles(net).areas.sum() == pytest.approx(enclosed, rel=1e-9, abs=1e-12)
    assert enclosed_region(sections).area == pytest.approx(enclosed, rel=1e-9, abs=1e-12)


@pytest.mark.parametrize("name", NAMES)
def test_areas_of_leaves_add_up(name):
    check_areas(named(name))


@given(seeds, st.floats(0.05, 1.0))
def test_areas_of_random_networks_add_up(seed, share):
    check_areas(random_planar(np.random.default_rng(seed), 50, share))


@given(seeds)
def test_areas_add_up_where_veins_cross(seed):
    check_areas(tangle(seed))


def check_turned(net, widths, angle, size):
    """All numbers of a leaf that is turned and enlarged, against those as it was."""
    turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    places = size * net.positions @ turn.T
    plain, moved = (
        network_statistics(RealNetwork.from_edges(positions, net.segments, widths=of_segments))
        for positions, of_segments in ((net.positions, widths), (places, size * widths))
    )
    compare(plain, moved, size)


def compare(plain, moved, size):
    """Numbers scale by the power of a length that they are; boxes do not turn with the leaf."""
    for key, value in plain.items():
        if isinstance(value, dict):
            compare(value, moved[key], size)
        elif key == "box_dimension":
            assert moved[key] == pytest.approx(value, abs=0.1)
        elif isinstance(value, float):
            margin = 0.03 if key.startswith(BY_PLACES) else 1e-6
            unit = size ** POWERS.get(key, 0)
            assert moved[key] == pytest.approx(value * unit, rel=margin, abs=1e-9 * unit), key
        else:
            assert moved[key] == value, key


@settings(max_examples=15)
@given(seeds, st.floats(0.0, 6.3), st.floats(0.01, 100.0))
def test_turned_and_enlarged(seed, angle, size):
    rng = np.random.default_rng(seed)
    net = random_planar(rng, 60, 0.7)
    check_turned(net, rng.uniform(1.0, 9.0, net.n_segments), angle, size)


@pytest.mark.parametrize("name", ["closed", "areole"])
def test_turned_and_enlarged_leaves(name):
    net = named(name)
    widths = np.random.default_rng(0).uniform(1.0, 9.0, net.n_segments)
    check_turned(net, widths, 1.0, 7.0)
