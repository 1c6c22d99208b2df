"""The detector of strands, on fields made by hand and on canals that have formed."""

from itertools import pairwise

import numpy as np
import pytest

from vasc.analysis.strand_shapes import THRESHOLDS, landings
from vasc.analysis.strands import read_strand
from vasc.domain.tilings import rectangular
from vasc.domain.tissue import Tissue
from vasc.fields import Fields, Role

COLUMNS, ROWS = 15, 15
ACTIVATION = 10.0


def cell(x, y):
    return y * COLUMNS + x


def painted(tissue, lines, source, veins):
    """Fields in which each line of cells carries a flux, and other walls none."""
    flux = np.zeros(tissue.n_walls)
    carriers = np.ones((tissue.n_walls, 2))
    for cells, amount in lines:
        for a, b in pairwise(cells):
            low, high = sorted((a, b))
            wall = int(np.flatnonzero((tissue.walls == (low, high)).all(axis=1))[0])
            flux[wall] += amount if a < b else -amount
            carriers[wall] = 100.0
    roles = np.zeros(tissue.n_cells, dtype=np.int8)
    roles[source] = Role.SOURCE
    roles[np.concatenate(veins)] = Role.VEIN
    return Fields(np.zeros(tissue.n_cells), flux, carriers, roles)


@pytest.fixture(scope="module")
def tissue():
    return rectangular(COLUMNS, ROWS)


def up(x, y, to):
    return [cell(x, one) for one in range(y, to + 1)]


def test_a_single_file_is_one_cell_wide(tissue):
    vein = [np.array([cell(7, 14)]), np.array([cell(0, 0)])]
    fields = painted(tissue, [(up(7, 2, 14), 1.0)], cell(7, 2), vein)
    strand = read_strand(tissue, fields, cell(7, 2), vein, ACTIVATION)
    assert strand.width == 1.0
    assert strand.is_formed
    assert (strand.reached, strand.main, strand.groups) == (0, 0, (0,))
    assert strand.shares.tolist() == [1.0, 0.0]
    assert strand.tortuosity == strand.detour == 1.0
    # the other vein is nearer: 7 cells aside and 2 below
    assert strand.excess == pytest.approx(12.0 / np.hypot(7, 2))
    assert not strand.is_nearest(strand.reached)
    assert not strand.is_nearest(strand.reached, by_cells=True)
    assert strand.ways.tolist() == [12.0, 9.0]
    assert (strand.is_loop, strand.is_vortex, strand.n_landings) == (False, False, 1)


def test_flux_through_resting_walls_is_no_strand(tissue):
    vein = [np.array([cell(7, 14)])]
    fields = painted(tissue, [(up(7, 2, 14), 1.0)], cell(7, 2), vein)
    fields = fields._replace(carriers=np.ones_like(fields.carriers))
    strand = read_strand(tissue, fields, cell(7, 2), vein, ACTIVATION)
    assert not strand.is_formed
    assert (strand.n_strands, strand.n_landings) == (0, 0)
    # the largest flux leads there all the same
    assert strand.reached == 0


def test_a_wall_at_rest_interrupts_a_strand(tissue):
    vein = [np.array([cell(7, 14)])]
    fields = painted(tissue, [(up(7, 2, 14), 1.0)], cell(7, 2), vein)
    fields.carriers[np.flatnonzero(fields.flux)[5]] = 9.9
    assert not read_strand(tissue, fields, cell(7, 2), vein, ACTIVATION).is_formed


def test_two_equal_strands_are_two(tissue):
    source = cell(7, 7)
    vein = [np.array([cell(7, 14)]), np.array([cell(7, 0)])]
    down = [cell(7, one) for one in range(7, -1, -1)]
    lines = [(up(7, 7, 14), 0.5), (down, 0.5)]
    strand = read_strand(tissue, painted(tissue, lines, source, vein), source, vein, ACTIVATION)
    assert strand.n_strands == strand.n_landings == 2
    assert strand.shares.tolist() == [0.5, 0.5]
    assert strand.width == 2.0
    assert strand.is_nearest(0)
    assert strand.is_nearest(1)


def test_a_trickle_is_no_second_strand(tissue):
    source = cell(7, 7)
    vein = [np.array([cell(7, 14)]), np.array([cell(7, 0)])]
    down = [cell(7, one) for one in range(7, -1, -1)]
    lines = [(up(7, 7, 14), 0.93), (down, 0.07)]
    strand = read_strand(tissue, painted(tissue, lines, source, vein), source, vein, ACTIVATION)
    assert strand.groups == (0,)
    assert strand.n_landings == 1


def test_a_vein_ends_a_strand(tissue):
    # background makes a canal from the other vein to the same vein cell: it is not ours
    source = cell(7, 2)
    vein = [np.array([cell(7, 8)]), np.array([cell(7, 14)])]
    lines = [(up(7, 2, 8), 0.8), ([cell(7, 11), cell(7, 12), cell(7, 13), cell(7, 14)], 0.2)]
    lines.append(([cell(7, 11), cell(7, 10), cell(7, 9), cell(7, 8)], 0.2))
    strand = read_strand(tissue, painted(tissue, lines, source, vein), source, vein, ACTIVATION)
    assert strand.shares == pytest.approx([1.0 / 1.2, 0.2 / 1.2])
    assert strand.groups == (0,)


def test_a_ring_of_flux_is_a_loop_and_a_vortex(tissue):
    source = cell(7, 7)
    ring = [source, cell(8, 7), cell(8, 8), cell(7, 8), source]
    vein = [np.array([cell(7, 14)])]
    lines = [(ring, 5.0), (up(7, 8, 14), 1.0)]
    strand = read_strand(tissue, painted(tissue, lines, source, vein), source, vein, ACTIVATION)
    assert strand.is_loop
    assert strand.reached == -1
    assert strand.is_vortex
    assert np.isnan(strand.width)
    assert np.isnan(strand.tortuosity)
    assert np.isnan(strand.excess)


def test_ends_on_one_vein_are_counted_apart(tissue):
    vein = np.array([cell(x, 14) for x in range(COLUMNS)])
    inflow = np.zeros(tissue.n_cells)
    inflow[vein[[2, 3]]] = 0.3, 0.2
    inflow[vein[[7, 9]]] = 0.3, 0.2
    inflow[vein[12]] = 0.07
    inflow[vein[14]] = 0.02
    found = landings(tissue, inflow, THRESHOLDS)
    assert found == (vein[2], vein[7], vein[9])
    assert landings(tissue, np.zeros(tissue.n_cells), THRESHOLDS) == ()


def test_the_order_of_the_cells_of_a_wall_does_not_matter(tissue):
    source = cell(3, 2)
    vein = [np.array([cell(7, 14)]), np.array([cell(0, 12)])]
    way = [*up(3, 2, 9), *(cell(x, 9) for x in range(4, 8)), *up(7, 10, 14)]
    fields = painted(tissue, [(way, 1.0)], source, vein)
    fields.carriers[:, 1] = 1.0
    swapped = Tissue(
        positions=tissue.positions,
        volumes=tissue.volumes,
        walls=np.ascontiguousarray(tissue.walls[:, ::-1]),
        lengths=tissue.lengths,
        distances=tissue.distances,
        corners=tissue.corners,
        starts=tissue.starts,
        blade=tissue.blade,
    )
    turned = fields._replace(flux=-fields.flux, carriers=fields.carriers[:, ::-1].copy())
    one = read_strand(tissue, fields, source, vein, ACTIVATION)
    other = read_strand(swapped, turned, source, vein, ACTIVATION)
    for name in ("shares", "path", "distances", "ways"):
        np.testing.assert_array_equal(getattr(one, name), getattr(other, name))
    for name in ("main", "reached", "groups", "landings", "width", "length", "is_formed"):
        assert getattr(one, name) == getattr(other, name)
    assert one.is_formed
    assert one.tortuosity > 1.0


def test_without_flux_there_is_no_strand(tissue):
    vein = [np.array([cell(7, 14)])]
    fields = painted(tissue, [], cell(7, 2), vein)
    strand = read_strand(tissue, fields, cell(7, 2), vein, ACTIVATION)
    assert (strand.main, strand.reached, strand.is_formed) == (-1, -1, False)
    assert strand.shares.tolist() == [0.0]
