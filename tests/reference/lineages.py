"""Lineage told node by node and row by row, as slowly and plainly as it can be."""

from vasc.events import EventKind
from vasc.network import Origin, SegmentKind


def rows(timeline, table):
    """Give a table as a list of dicts."""
    from vasc.timeline.layout import TABLES

    names = list(TABLES[table])
    columns = [timeline.table(table, name).tolist() for name in names]
    return [dict(zip(names, row, strict=True)) for row in zip(*columns, strict=True)]


def veins(timeline):
    """Give the first node of the vein of each node, and its branching order."""
    nodes, segments, events = (rows(timeline, name) for name in ("nodes", "segments", "events"))
    begun = {e["subject"] for e in events if e["kind"] == EventKind.VEIN_INITIATED}
    halved = {e["object"]: e["subject"] for e in events if e["kind"] == EventKind.SEGMENT_REFINED}
    firsts, orders = [], []
    for node, row in enumerate(nodes):
        parent = row["parent"]
        if parent == -1:
            firsts.append(node)
            orders.append(1)
            continue
        before = parent
        if row["origin"] == Origin.REFINEMENT and node in halved:
            segment = segments[halved[node]]
            is_join = segment["kind"] == SegmentKind.JOIN
            before = segment["nodes"][0] if is_join else max(segment["nodes"])
        is_first = node in begun
        firsts.append(node if is_first else firsts[before])
        leaves_seed = nodes[parent]["parent"] == -1
        orders.append(orders[before] + (1 if is_first and not leaves_seed else 0))
    return firsts, orders


def births(timeline):
    """Give (step, vein, order, origin, height, nodes) of every vein, by step."""
    firsts, orders = veins(timeline)
    nodes = rows(timeline, "nodes")
    found = []
    for vein in sorted(set(firsts)):
        step, parent = nodes[vein]["birth"], nodes[vein]["parent"]
        places = timeline.positions(step)
        height = places[vein][-1] - places[0][-1]
        origin = -1 if parent == -1 else firsts[parent]
        found.append((step, vein, orders[vein], origin, height, firsts.count(vein)))
    return sorted(found)


def competitors(timeline, source):
    """Give {vein: (first step, last step, number of nodes)} of what a source attracted."""
    firsts, _ = veins(timeline)
    found = {}
    for row in rows(timeline, "perceived"):
        if row["source"] == source:
            steps, nodes = found.setdefault(firsts[row["node"]], ([], set()))
            steps.append(row["step"])
            nodes.add(row["node"])
    return {vein: (min(steps), max(steps), len(nodes)) for vein, (steps, nodes) in found.items()}


def life_table(births, deaths, last_step):
    """Give (at risk, deaths, survival) for every age."""
    ages = [
        (death if death != -1 else last_step) - birth
        for birth, death in zip(births, deaths, strict=True)
    ]
    found, share = [], 1.0
    for age in range(max(ages) + 1 if ages else 0):
        at_risk = sum(a >= age for a in ages)
        died = sum(a == age and d != -1 for a, d in zip(ages, deaths, strict=True))
        share *= 1.0 - died / at_risk
        found.append((at_risk, died, share))
    return found
