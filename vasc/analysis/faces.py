"""Vein networks as planar drawings: segments are cut where they cross."""

import numpy as np
from numpy.typing import NDArray

from vasc import kernels
from vasc.faces import Drawing
from vasc.network import VeinNetwork

MAX_CELLS = 4_000_000
"""Search cells at most, so that a few long segments cannot ask for endless memory."""


def planar_drawing(network: VeinNetwork) -> Drawing:
    """Cut the segments of a network where they cross, touch or overlap.

    Parameters
    ----------
    network : VeinNetwork
        Any network; it may be empty.

    Returns
    -------
    Drawing
        The network itself if nothing had to be cut.
    """
    if network.n_segments == 0:
        return Drawing(network.positions, network.segments)
    points = np.ascontiguousarray(network.positions)
    is_point = network.lengths == 0.0
    pairs = kernels.contacts.segment_contacts(points, network.segments, _cell_side(network))
    if not len(pairs) and not is_point.any():
        return Drawing(points, network.segments)
    is_cut = np.zeros(network.n_segments, dtype=bool)
    is_cut[pairs.ravel()] = True
    pieces = _pieces(points[network.segments[is_cut & ~is_point]])
    ends = np.concatenate([points[network.segments[~is_cut & ~is_point]], pieces])
    unique, rows = np.unique(ends.reshape(-1, 2), axis=0, return_inverse=True)
    segments = np.unique(np.sort(rows.reshape(-1, 2), axis=1), axis=0).astype(np.int32)
    return Drawing(unique, segments)


def _cell_side(network: VeinNetwork) -> float:
    """Give a side for search cells: about two segments long, and not too many cells."""
    extent = np.ptp(network.positions, axis=0)
    side = max(2.0 * float(network.lengths.mean()), 1e-9 * float(extent.max()), 1e-300)
    return max(side, float(np.sqrt(extent[0] * extent[1] / MAX_CELLS)), float(extent.max()) / 1e6)


def _pieces(lines: NDArray[np.float64]) -> NDArray[np.float64]:
    """Cut lines, shape (k, 2, 2), at each other; the pieces have the same form."""
    import shapely

    noded = shapely.get_parts(shapely.unary_union(shapely.multilinestrings(lines)))
    coordinates, owners = shapely.get_coordinates(noded, return_index=True)
    is_inner = owners[1:] == owners[:-1]
    return np.stack([coordinates[:-1][is_inner], coordinates[1:][is_inner]], axis=1)
