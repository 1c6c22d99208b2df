"""The straightforward way: scipy's search tree, built anew in every step.

Open venation asks the tree for the nearest node of each source; closed venation
takes the 64 nearest nodes as candidates and tests them against each other, which
misses far relative neighbours: it is a lower bound on the work of an exact one.
"""

import numpy as np
from scipy.spatial import cKDTree

N_CANDIDATES = 64


def nearest_pairs(sources, nodes):
    """Rows (source, node): the nearest node of every source."""
    _, found = cKDTree(nodes).query(sources)
    return np.arange(len(sources)), found


def relative_pairs(sources, nodes):
    """Rows (source, node): relative neighbours among the nearest nodes."""
    n_candidates = min(N_CANDIDATES, len(nodes))
    distances, found = cKDTree(nodes).query(sources, k=n_candidates)
    distances, found = distances.reshape(len(sources), -1), found.reshape(len(sources), -1)
    rows, members = [], []
    for start in range(0, len(sources), 256):
        d, ids = distances[start : start + 256], found[start : start + 256]
        points = nodes[ids]
        between = np.sqrt(((points[:, :, None] - points[:, None]) ** 2).sum(axis=3))
        closer = np.tri(n_candidates, k=-1, dtype=bool)
        excluded = ((between < d[:, :, None]) & closer).any(axis=2)
        source, place = np.nonzero(~excluded)
        rows.append(source + start)
        members.append(ids[source, place])
    return np.concatenate(rows), np.concatenate(members)


def association_seconds(kind, sources, nodes, clock):
    """CPU seconds of one association of all sources with all nodes."""
    pairs = nearest_pairs if kind == "open" else relative_pairs
    started = clock()
    pairs(sources, nodes)
    return clock() - started
