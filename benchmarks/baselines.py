"""The straightforward way: scipy's search tree, built anew in every step.

Open venation asks the tree for the nearest node of each source. Closed venation
takes the 64 nearest nodes as candidates and tests them against each other, which
misses far relative neighbours: it is a lower bound on the work of an exact one.

``grow`` is a whole simulation in numpy around these, with a random stream of its
own and simplified tags: the veins a source waits for are followed by their nodes.
"""

import time

import numpy as np
from scipy.spatial import cKDTree

N_CANDIDATES = 64
N_AT_ONCE = 256


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
    for start in range(0, len(sources), N_AT_ONCE):
        d, ids = distances[start : start + N_AT_ONCE], found[start : start + N_AT_ONCE]
        points = nodes[ids]
        between = np.sqrt(((points[:, :, None] - points[:, None]) ** 2).sum(axis=3))
        closer = np.tri(n_candidates, k=-1, dtype=bool)
        excluded = ((between < d[:, :, None]) & closer).any(axis=2)
        source, place = np.nonzero(~excluded)
        rows.append(source + start)
        members.append(ids[source, place])
    return np.concatenate(rows), np.concatenate(members)


PAIRS = {"open": nearest_pairs, "closed": relative_pairs}


def association_seconds(kind, sources, nodes):
    """CPU seconds of one association of all sources with all nodes."""
    started = time.process_time()
    PAIRS[kind](sources, nodes)
    return time.process_time() - started


def darts(rng, blade, n_darts, sources, nodes, exclusion):
    """Sources of a step: uniform in the blade, away from sources, nodes and each other."""
    low_x, low_y, high_x, high_y = blade.bounds
    thrown = np.empty((0, 2))
    while len(thrown) < n_darts:
        points = rng.uniform((low_x, low_y), (high_x, high_y), size=(2 * n_darts, 2))
        thrown = np.concatenate([thrown, points[blade.contains(points)]])
    thrown = thrown[:n_darts]
    is_free = cKDTree(nodes).query(thrown)[0] > exclusion["veins"]
    if len(sources):
        is_free &= cKDTree(sources).query(thrown)[0] > exclusion["sources"]
    placed = []
    for dart in thrown[is_free]:
        if all(np.hypot(*(dart - other)) > exclusion["sources"] for other in placed):
            placed.append(dart)
    return np.array(placed).reshape(-1, 2)


def extend(sources, nodes, rows, members, segment):
    """Nodes that grow one segment each: their rows, and the new positions."""
    apart = sources[rows] - nodes[members]
    distances = np.sqrt((apart**2).sum(axis=1))
    pulled, place, n_pulls = np.unique(members, return_inverse=True, return_counts=True)
    total = np.zeros((len(pulled), 2))
    np.add.at(total, place, apart / distances[:, None])
    order = np.lexsort((distances, place))
    nearest = order[np.searchsorted(place[order], np.arange(len(pulled)))]
    length = np.sqrt((total**2).sum(axis=1))
    # sources that cancel each other out: toward the nearest one
    is_stalled = length / n_pulls <= segment / (2.0 * distances[nearest])
    total[is_stalled] = apart[nearest][is_stalled]
    total /= np.sqrt((total**2).sum(axis=1))[:, None]
    return pulled, nodes[pulled] + segment * total


def grow(parameters, *, most_seconds):
    """Grow a leaf until it is finished or the time is spent.

    Returns steps, nodes, source-iterations and CPU seconds.
    """
    started = time.process_time()
    rng = np.random.default_rng(parameters.seed)
    growth = parameters.model().growth
    kill, segment = parameters.arrival.kill_distance, parameters.extension.segment_length
    placement = parameters.placement
    exclusion = {
        "veins": max(placement.birth_distance_veins, kill),
        "sources": placement.birth_distance_sources,
    }
    last_dart = growth.last_step if placement.until is None else placement.until
    nodes, sources, awaited = growth.blade.seeds.copy(), np.empty((0, 2)), []
    step = n_pairs = 0
    carry, length = 0.0, growth.blade.length
    while time.process_time() - started < most_seconds:
        step += 1
        blade = growth.domain(step)
        if parameters.growth.kind == "isogonic":
            nodes, sources = nodes * (blade.length / length), sources * (blade.length / length)
        length = blade.length
        if step <= last_dart:
            carry += placement.density * blade.area
            n_darts, carry = int(carry), carry % 1.0
            if n_darts:
                born = darts(rng, blade, n_darts, sources, nodes, exclusion)
                sources = np.concatenate([sources, born])
                awaited += [None] * len(born)
        elif not len(sources):
            break
        if not len(sources):
            continue
        n_pairs += len(sources)
        rows, members = PAIRS[parameters.kind](sources, nodes)
        is_far = np.hypot(*(sources[rows] - nodes[members]).T) >= kill
        is_awaited = [
            awaited[s] is None or v in awaited[s] for s, v in zip(rows, members, strict=True)
        ]
        does_pull = is_far & np.array(is_awaited)
        if not does_pull.any() and step > last_dart:
            break
        pulled, new = extend(sources, nodes, rows[does_pull], members[does_pull], segment)
        first = len(nodes)
        nodes = np.concatenate([nodes, new])
        children = dict(zip(pulled.tolist(), range(first, len(nodes)), strict=True))
        is_alive = reach(parameters.kind, sources, nodes, (rows, members), awaited, children, kill)
        sources = sources[is_alive]
        awaited = [veins for veins, alive in zip(awaited, is_alive, strict=True) if alive]
    return step, len(nodes), n_pairs, time.process_time() - started


def reach(kind, sources, nodes, pairs, awaited, children, kill):
    """Follow the veins that sources wait for; tell which sources live on."""
    distances = cKDTree(nodes).query(sources)[0]
    if kind == "open":
        return distances >= kill
    is_alive = np.ones(len(sources), dtype=bool)
    rows, members = pairs
    for source in np.flatnonzero(distances < kill):
        veins = awaited[source]
        if veins is None:
            veins = set(members[rows == source].tolist())
        veins |= {children[vein] for vein in veins if vein in children}
        awaited[source] = veins
        followed = np.fromiter(veins, dtype=int)
        now = relative_pairs(sources[source : source + 1], nodes)[1]
        now = now[np.hypot(*(nodes[now] - sources[source]).T) >= kill]
        is_alive[source] = np.isin(now, followed).any()
    return is_alive
