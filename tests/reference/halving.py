"""Halving of segments, as growth makes it necessary: new nodes last, ids of old ones kept."""

from dataclasses import fields

import numpy as np
from reference.networks import network

from vasc.network import Growths, Origin, SegmentKind


def growths(whole):
    """What grew in each segment; in a network that was never halved, its newer node."""
    if whole.growths is not None:
        return whole.growths
    newer = whole.segments.max(axis=1)
    return Growths(whole.segment_ids, newer, whole.segment_births, whole.causes[newer])


def repeated(grown, times):
    """The same growths, each as often as it has pieces."""
    columns = (getattr(grown, column.name) for column in fields(grown))
    return Growths(*(np.repeat(column, times) for column in columns))


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
    pieces = [2 if row in rows else 1 for row in range(whole.n_segments)]
    return network(
        np.array(points),
        segments,
        kinds=kinds,
        origins=origins,
        parents=parents,
        births=births,
        growths=repeated(growths(whole), pieces),
    )


def extended(whole, node, point):
    """The network with a new node that extends ``node``."""
    new, birth = whole.n_nodes, whole.births.max() + 1
    return network(
        np.vstack([whole.positions, [point]]),
        np.vstack([whole.segments, [[node, new]]]),
        kinds=np.r_[whole.segment_kinds, SegmentKind.EXTENSION],
        origins=np.r_[whole.origins, Origin.EXTENSION],
        parents=np.r_[whole.parents, node],
        births=np.r_[whole.births, birth],
        growths=_one_more(whole, new, birth, new // 3),
    )


def joined(whole, older, newer):
    """The network with two nodes joined."""
    birth = max(whole.births[older], whole.births[newer])
    return network(
        whole.positions,
        np.vstack([whole.segments, [[older, newer]]]),
        kinds=np.r_[whole.segment_kinds, SegmentKind.JOIN],
        origins=whole.origins,
        parents=whole.parents,
        births=whole.births,
        growths=_one_more(whole, newer, birth, whole.causes[newer]),
    )


def _one_more(whole, node, birth, cause):
    """The growths of a network with one segment more."""
    known = growths(whole)
    return Growths(
        np.r_[known.ids, known.ids.max(initial=-1) + 1].astype(np.int32),
        np.r_[known.nodes, node].astype(np.int32),
        np.r_[known.births, birth].astype(np.int32),
        np.r_[known.causes, cause].astype(np.int32),
    )
