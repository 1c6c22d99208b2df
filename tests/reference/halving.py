"""Halving of segments, as growth makes it necessary: new nodes last, ids of old ones kept."""

import numpy as np
from reference.networks import network

from vasc.network import Origin, SegmentKind


def halved(whole, rows):
    """The network with the segments in ``rows`` halved."""
    points = whole.positions.tolist()
    parents, births = whole.parents.tolist(), whole.births.tolist()
    origins, segments, kinds = whole.origins.tolist(), [], []
    for row, (first, second) in enumerate(whole.segments.tolist()):
        if row not in rows:
            segments.append((first, second))
            kinds.append(whole.segment_kinds[row])
            continue
        middle = len(points)
        points.append(((whole.positions[first] + whole.positions[second]) / 2).tolist())
        parents.append(first)
        births.append(max(births) + 1)
        origins.append(Origin.REFINEMENT)
        segments += [(first, middle), (middle, second)]
        kinds += [SegmentKind.REFINEMENT] * 2
    return network(
        np.array(points), segments, kinds=kinds, origins=origins, parents=parents, births=births
    )


def extended(whole, node, point):
    """The network with a new node that extends ``node``."""
    new = whole.n_nodes
    return network(
        np.vstack([whole.positions, [point]]),
        np.vstack([whole.segments, [[node, new]]]),
        kinds=np.r_[whole.segment_kinds, SegmentKind.EXTENSION],
        origins=np.r_[whole.origins, Origin.EXTENSION],
        parents=np.r_[whole.parents, node],
        births=np.r_[whole.births, whole.births.max() + 1],
    )


def joined(whole, older, newer):
    """The network with two nodes joined."""
    return network(
        whole.positions,
        np.vstack([whole.segments, [[older, newer]]]),
        kinds=np.r_[whole.segment_kinds, SegmentKind.JOIN],
        origins=whole.origins,
        parents=whole.parents,
        births=whole.births,
    )
