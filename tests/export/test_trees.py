"""SWC and MTG hold the tree that a run without joins is, and refuse others."""

import re

import numpy as np
import pytest

from vasc.errors import VascError
from vasc.export import export, specimen
from vasc.timeline import Timeline


def edges_of(found):
    """Give the pairs of node ids, proximal first."""
    return {tuple(pair) for pair in found.ids[found.ends].tolist()}


def read_mtg(text):
    """Read a multiscale tree graph: edges with their type by id, and features by id.

    A code stands in the column of its axis. ``^`` follows the last entity in the same column,
    anything else the last one in the column to the left.
    """
    lines = [line for line in text.splitlines() if line and not line.startswith("#")]
    start = lines.index("MTG:") + 1
    _, *words = lines[start].split("\t")
    n_columns = words.count("") + 1
    names = words[n_columns - 1 :]
    edges, features, last, plants = {}, {}, {}, []
    for line in lines[start + 1 :]:
        cells = line.split("\t")
        column = next(k for k, cell in enumerate(cells) if cell)
        code = re.fullmatch(r"(?:(/P\d+)/|(\^<)|(\+))N(\d+)", cells[column])
        plant, goes_on, branches, node = code.groups()
        node = int(node)
        if plant:
            assert column == 0
            plants.append(plant)
        else:
            parent = last[column if goes_on else column - 1]
            edges[parent, node] = "<" if goes_on else "+"
            assert bool(branches) != bool(goes_on)
        last[column] = node
        last = {key: value for key, value in last.items() if key <= column}
        features[node] = dict(zip(names, cells[n_columns:], strict=True))
    return edges, features, plants


def test_swc_holds_every_node_and_segment(runs, tmp_path):
    with Timeline(runs.open) as timeline:
        found = specimen(timeline)
    file = export(runs.open, tmp_path / "a.swc")
    assert file.read_text().startswith("".join(f"# {line}\n" for line in found.heading))
    rows = np.loadtxt(file)
    assert rows[:, 0].tolist() == list(range(1, len(found.ids) + 1))
    numbers, parents = rows[:, 0].astype(int), rows[:, 6].astype(int)
    # a parent comes before its children
    assert (parents < numbers).all()
    assert (parents == -1).sum() == 1
    order = np.argsort(found.ranks)
    np.testing.assert_array_equal(rows[:, 2:4], found.positions[order])
    np.testing.assert_array_equal(rows[:, 5], found.radii[order])
    has_parent = parents > 0
    pairs = zip(order[parents[has_parent] - 1], order[numbers[has_parent] - 1], strict=True)
    assert {(found.ids[a], found.ids[b]) for a, b in pairs} == edges_of(found)
    steps = rows[has_parent, 2:5] - rows[parents[has_parent] - 1, 2:5]
    assert np.linalg.norm(steps, axis=1).sum() == pytest.approx(found.lengths.sum())


def test_swc_says_what_its_numbers_are(runs, tmp_path):
    with Timeline(runs.open) as timeline:
        found = specimen(timeline)
    file = export(runs.open, tmp_path / "a.swc")
    assert "# n is the id of the node + 1, as SWC counts from 1\n" in file.read_text()
    rows = np.loadtxt(file)
    at = {node: place.tolist() for node, place in zip(found.ids, found.positions, strict=True)}
    assert [at[int(number) - 1] for number in rows[:, 0]] == rows[:, 2:4].tolist()
    refined = export(runs.areoles, tmp_path / "b.swc", spanning_tree=True)
    assert "# n counts the points from 1 and is no id" in refined.read_text()
    assert "as SWC counts" not in refined.read_text()


def test_mtg_holds_every_node_and_segment(runs, tmp_path):
    with Timeline(runs.open) as timeline:
        found = specimen(timeline)
    edges, features, plants = read_mtg(export(runs.open, tmp_path / "a.mtg").read_text())
    assert set(edges) == edges_of(found)
    assert plants == ["/P1"]
    assert set(features) == set(found.ids.tolist())
    places = [[float(features[node][axis]) for axis in ("XX", "YY")] for node in found.ids.tolist()]
    np.testing.assert_array_equal(places, found.positions)
    assert [int(features[node]["Birth"]) for node in found.ids.tolist()] == found.births.tolist()
    # at most one segment goes on at a node, and no other is thicker
    widths = dict(
        zip(map(tuple, found.ids[found.ends].tolist()), found.widths.tolist(), strict=True)
    )
    main = [pair for pair, sign in edges.items() if sign == "<"]
    assert len({parent for parent, _ in main}) == len(main)
    for parent, node in main:
        others = [width for (start, _), width in widths.items() if start == parent]
        assert widths[parent, node] == max(others)
    assert "+" in edges.values()


@pytest.mark.parametrize("suffix", [".swc", ".mtg"])
def test_where_veins_join_a_tree_is_refused_or_spanned(runs, suffix, tmp_path):
    for path in (runs.closed, runs.stem):
        file = tmp_path / f"{path.stem}{suffix}"
        with pytest.raises(VascError, match=r"veins join at \d+ nodes.*--spanning-tree"):
            export(path, file)
        assert not file.exists()
        export(path, file, spanning_tree=True)
        assert "# a spanning tree" in file.read_text()
        with Timeline(path) as timeline:
            found = specimen(timeline)
        if suffix == ".swc":
            rows = np.loadtxt(file)
            parents = rows[:, 6].astype(int)
            assert len(rows) == len(found.ids)
            assert (parents < rows[:, 0]).all()
            # only bases have no parent
            is_base = ~np.isin(np.arange(len(found.ids)), found.ends[:, 1])
            assert (parents == -1).sum() == is_base.sum()
        else:
            edges, features, plants = read_mtg(file.read_text())
            assert set(edges) < edges_of(found)
            assert len(features) == len(found.ids) == len(edges) + len(plants)
            # what is left out are joins
            joins = {
                tuple(pair)
                for pair, kind in zip(
                    found.ids[found.ends].tolist(), found.kinds.tolist(), strict=True
                )
                if kind == 1
            }
            if path == runs.closed:
                assert edges_of(found) - set(edges) <= joins


def test_a_young_leaf_is_a_tree_even_if_it_has_loops_later(runs, tmp_path):
    with Timeline(runs.closed) as timeline:
        joins = timeline.table("segments", "birth")[timeline.table("segments", "kind") == 1]
    rows = np.loadtxt(export(runs.closed, tmp_path / "a.swc", int(joins.min()) - 1))
    assert len(rows) > 10


def test_a_seed_alone_is_a_tree(runs, tmp_path):
    assert np.loadtxt(export(runs.open, tmp_path / "a.swc", 0)).tolist() == [1, 0, 0, 0, 0, 0, -1]
    edges, features, _ = read_mtg(export(runs.open, tmp_path / "a.mtg", 0).read_text())
    assert edges == {}
    assert list(features) == [0]
