"""Tables as CSV, read by pandas, and as data frames."""

import json

import numpy as np
import pandas as pd
import pytest

from vasc.export import data_frames, export, specimen
from vasc.export.tables import DESCRIPTION, TABLES
from vasc.timeline import Timeline


def read(folder):
    """Read all tables of a folder."""
    return {
        name: pd.read_csv(folder / f"{name}.csv", index_col=None if name == "states" else 0)
        for name in TABLES
    }


def test_pandas_reads_what_the_timeline_holds(timeline, tmp_path):
    tables = read(export(timeline, tmp_path / "a.csv"))
    scale = 4.0 if timeline.units else 1.0
    for name in ("nodes", "segments", "sources", "events", "areoles", "states"):
        own = timeline.to_pandas(name)
        assert len(tables[name]) == len(own)
        for column in own.columns:
            if (name, column) == ("states", "state"):
                continue
            values = own[column]
            is_length = column.startswith(("position", "material"))
            if str(values.dtype) == "category":
                assert tables[name][column].tolist() == values.astype(str).tolist()
            else:
                np.testing.assert_allclose(
                    tables[name][column].astype(float), values * (scale if is_length else 1)
                )
    frames = timeline.to_pandas("frames")
    np.testing.assert_array_equal(tables["frames"]["n_nodes"], frames["n_nodes"])
    assert tables["frames"].index.tolist() == list(range(timeline.n_frames))


def test_states_have_names(timeline, tmp_path):
    states = read(export(timeline, tmp_path / "a.csv"))["states"]
    words = {
        "source": {"active", "tagged", "drained"},
        "canal": {"ground", "pre_pattern", "inbound", "outbound", "vein", "arrested"},
        "node": {"vein"},
    }
    for what, rows in states.groupby("what"):
        assert set(rows["state"]) <= words[what]
    assert len(states) == timeline.n_rows("states")


def test_nodes_and_segments_have_their_place_and_width_at_the_step(timeline, tmp_path):
    tables, found = read(export(timeline, tmp_path / "a.csv")), specimen(timeline)
    nodes, segments = tables["nodes"].loc[found.ids], tables["segments"].loc[found.segment_ids]
    # pandas before 3 reads numbers to the last digit but one
    np.testing.assert_allclose(nodes[list(found.axes)], found.positions, rtol=1e-14)
    np.testing.assert_allclose(nodes["radius"], found.radii, rtol=1e-14)
    for name in ("order", "branching_order", "gravelius_order", "width", "length"):
        np.testing.assert_allclose(segments[name], getattr(found, f"{name}s"), rtol=1e-14)
    # what refinement has replaced is there, without a place
    replaced = tables["nodes"].drop(found.ids)
    assert replaced["x"].isna().all()


def test_tables_end_with_the_step(runs, tmp_path):
    tables = read(export(runs.closed, tmp_path / "a.csv", 20))
    assert tables["frames"].index[-1] == 20
    with Timeline(runs.closed) as timeline:
        counts = timeline.frames
        for name in TABLES[1:]:
            assert len(tables[name]) == counts[f"n_{name}"][20]


def test_every_column_is_described(timeline, tmp_path):
    folder = export(timeline, tmp_path / "a.csv")
    about = json.loads((folder / DESCRIPTION).read_text())
    found = specimen(timeline)
    assert found.run in about["dc:title"]
    assert f"step {found.step}" in about["dc:description"]
    assert [table["url"] for table in about["tables"]] == [f"{name}.csv" for name in TABLES]
    for table in about["tables"]:
        header = (folder / table["url"]).read_text().partition("\n")[0].split(",")
        described = table["tableSchema"]["columns"]
        assert [column["name"] for column in described] == header
        assert all(column["dc:description"] for column in described)
        units = {column["name"]: column["unit"] for column in described if "unit" in column}
        assert set(units.values()) <= {found.unit.name, "steps"}
        in_length = {name for name, unit in units.items() if unit == found.unit.name}
        if table["url"] == "nodes.csv":
            assert in_length >= {"x", "y", "radius", "position_x", "material_y"}
            assert "birth" not in in_length


def test_data_frames_are_the_tables(runs, tmp_path):
    with Timeline(runs.areoles) as timeline:
        found = data_frames(timeline)
    tables = read(export(runs.areoles, tmp_path / "a.csv"))
    assert set(found) == set(TABLES)
    for name, frame in found.items():
        assert frame.index.name == tables[name].index.name
        pd.testing.assert_frame_equal(
            frame, tables[name], check_dtype=False, check_index_type=False
        )


def test_data_frames_need_pandas(runs, monkeypatch):
    import sys

    from vasc.errors import VascError

    monkeypatch.setitem(sys.modules, "pandas", None)
    with (
        Timeline(runs.open) as timeline,
        pytest.raises(VascError, match=r"vasc\[tables\]"),
    ):
        data_frames(timeline)


def test_what_is_in_every_cell_is_described(timeline, tmp_path):
    folder = export(timeline, tmp_path / "a.csv")
    for table in json.loads((folder / DESCRIPTION).read_text())["tables"]:
        read_table = pd.read_csv(folder / table["url"], keep_default_na=False, dtype=str)
        for column in table["tableSchema"]["columns"]:
            cells = set(read_table[column["name"]])
            if column.get("datatype"):
                assert cells <= set(column["datatype"]["format"].split("|"))
            else:
                # numbers, and no word but what stands for none
                assert all(cell in column.get("null", ()) or cell[-1:].isdigit() for cell in cells)
                assert "-1" not in cells or "-1" in column.get("null", ()), column
            if column["name"] in ("step", "birth", "vein_birth", "time"):
                assert column["unit"] == "steps"
        columns = table["tableSchema"]["columns"]
        codes = {column["name"] for column in columns if "datatype" in column}
        assert {"nodes.csv": {"origin"}, "segments.csv": {"kind"}}.get(table["url"], codes) == codes


@pytest.mark.parametrize("kind", ["closed", "open", "areoles"])
def test_the_branching_order_is_that_of_lineage(runs, kind, tmp_path):
    segments = read(export(getattr(runs, kind), tmp_path / "a.csv"))["segments"]
    with Timeline(getattr(runs, kind)) as timeline:
        births = timeline.lineage.births()
    known = dict(zip(births["vein"].tolist(), births["branching_order"].tolist(), strict=True))
    # a vein begins with the segment to its first node, where refinement has left it whole
    is_whole = segments["branching_order"].notna() & (segments["kind"] == "extension")
    found = dict(zip(segments["nodes_distal"], segments["branching_order"], strict=True))
    compared = [node for node in segments["nodes_distal"][is_whole] if node in known]
    assert len(compared) > 3
    assert [found[node] for node in compared] == [known[node] for node in compared]


def test_orders_by_parentage_and_by_what_is_carried_are_two(runs):
    with Timeline(runs.closed) as timeline:
        found = specimen(timeline)
    assert (found.branching_orders != found.gravelius_orders).any()
