"""``vasc lineage``: its tables for people, as CSV and as JSON, and what it refuses."""

import csv
import io
import json
from dataclasses import replace

import numpy as np
import pytest
from reference.stem_run import STEM

from vasc.analysis import WidthParameters, run_node_orders
from vasc.cli import lineage_tables, main
from vasc.cli.lineage_tables import said
from vasc.timeline import Timeline
from vasc.timeline.life_table import MedianLife

TABLES = {
    "--life-table": "life_table",
    "--fates": "fates",
    "--births": "births",
    "--genealogy": "areoles",
}


@pytest.fixture(scope="module")
def leaf(recorded):
    """Give the recorded run."""
    return str(recorded / "leaf.h5")


def output(arguments, capsys):
    """Give what a verb writes when all is well."""
    assert main(arguments) == 0
    said = capsys.readouterr()
    assert said.err == ""
    return said.out


@pytest.mark.parametrize(("option", "name"), TABLES.items())
def test_a_table_is_the_same_in_json_csv_and_python(leaf, option, name, capsys):
    with Timeline(leaf) as timeline:
        widths = WidthParameters.model_validate(timeline.config.get("widths") or {})
        n_nodes = timeline.n_rows("nodes")
        orders = run_node_orders(timeline.frame, timeline.last_step, widths, n_nodes)
        table = timeline.lineage.table(name, orders)
    found = json.loads(output(["lineage", leaf, option, "--json"], capsys))
    rows = list(csv.DictReader(io.StringIO(output(["lineage", leaf, option, "--csv"], capsys))))
    n_rows = len(next(iter(table.values())))
    assert found["found"] == len(found[name]) == len(rows) == n_rows > 0
    assert list(rows[0]) == list(found[name][0]) == list(table)
    for column, values in table.items():
        if column == "fate":
            assert {row[column] for row in found[name]} <= {"reached", "ended", "joined"}
            continue
        told = [row[column] for row in found[name]]
        written = [row[column] for row in rows]
        for value, in_json, in_csv in zip(values.tolist(), told, written, strict=True):
            is_null = (value == -1 and values.dtype.kind == "i") or np.isnan(value)
            assert in_json == (None if is_null else value)
            assert in_csv == ("" if is_null else str(value))


def test_births_are_summed_up_by_order_for_people(leaf, capsys):
    lines = output(["lineage", leaf, "--births"], capsys).splitlines()
    assert lines[0].split() == ["order", "veins", "first", "median", "last"]
    by_order = json.loads(output(["lineage", leaf, "--births", "--json"], capsys))["by_order"]
    assert [int(line.split()[0]) for line in lines[1:]] == [row["order"] for row in by_order]


def test_competitors_of_a_source(leaf, capsys):
    found = json.loads(output(["lineage", leaf, "--competitors", "4", "--json"], capsys))
    with Timeline(leaf) as timeline:
        table = timeline.lineage.competitors(4)
    assert [row["vein"] for row in found["competitors"]] == table["vein"].tolist() != []
    text = output(["lineage", leaf, "--competitors", "4"], capsys)
    assert text.splitlines()[0].split() == list(table)
    assert {"first_recorded", "last_recorded", "nodes_recorded"} <= set(table)
    assert "holds a set when a vein enters or leaves it" in text.splitlines()[-1]


def test_a_limit_shortens_a_table(leaf, capsys):
    text = output(["lineage", leaf, "--fates", "--limit", "2"], capsys).splitlines()
    assert len(text) == 4
    assert text[-1].startswith("... and ")
    found = json.loads(output(["lineage", leaf, "--fates", "--limit", "2", "--json"], capsys))
    assert len(found["fates"]) == 2 < found["found"]


def test_the_loop_of_a_vein(leaf, capsys):
    with Timeline(leaf) as timeline:
        node = timeline.n_rows("nodes") - 1
        known = timeline.lineage.loop_of(node)
    found = json.loads(output(["lineage", leaf, "--loop", str(node), "--json"], capsys))
    assert (found["vein"], found["branching_order"]) == (known.vein, known.branching_order)
    assert found["areole"] == (None if known.areole < 0 else known.areole)


def test_an_areole_that_was_found_is_told_like_one_that_was_recorded(leaf, capsys):
    told = json.loads(output(["lineage", leaf, "--areole", "0", "--json"], capsys))
    with Timeline(leaf) as timeline:
        tree = timeline.lineage.genealogy()
    assert (told["birth"], told["segment"]) == (tree.births[0], tree.segments[0])


def test_lists_say_what_they_hold(leaf, capsys):
    def shown(*arguments):
        lines = output(["lineage", leaf, *arguments], capsys).splitlines()
        return dict(line.split(maxsplit=1) for line in lines)

    def told(*arguments):
        return json.loads(output(["lineage", leaf, *arguments, "--json"], capsys))

    assert told("--areole", "0")["ancestors"] == []
    assert shown("--areole", "0")["ancestors"] == "none"
    seed, tip = told("--node", "0"), told("--node", "1")
    assert (seed["ancestors"], tip["ancestors"]) == ([], [0])
    assert shown("--node", "0")["ancestors"] == "none"
    assert shown("--node", "1")["ancestors"] == "node 0"
    n_nodes = len(seed["descendants"])
    assert shown("--node", "0")["descendants"].startswith(f"{n_nodes:,} nodes: 1, 2, 3, ")
    assert ", " in shown("--node", "0")["position_at_birth"]


@pytest.mark.parametrize(
    ("arguments", "part"),
    [
        ([], "--life-table, --births, --genealogy"),
        ([], "for example: vasc lineage RUN.h5 --life-table"),
        (["--fates", "--births"], "--fates and --births are questions of their own"),
        (["--fates", "--node", "1"], "--node and --fates are questions of their own"),
        (["--genealogy", "--at", "1,2"], "--at and --genealogy are questions of their own"),
        (["--at", "1;2"], "must be two numbers X,Y"),
        (["--at", "1,2,3"], "must be two numbers X,Y"),
        (["--at", "1,nan"], "must be two numbers X,Y"),
        (["--at", "1000,0"], "off the blade"),
        (
            ["--at", "1e300,-1e300"],
            "the place 1e+300,-1e+300 is off the blade, far from the nearest",
        ),
        (["--fates", "--step", "3"], "--step is for --at"),
        (["--node", "1", "--csv"], "--csv is for tables"),
        (["--fates", "--csv", "--json"], "excludes --json"),
        (["--competitors", "99999"], "there is no source 99999"),
        (["--loop", "999999"], "there is no node 999999"),
    ],
)
def test_what_cannot_be_answered_is_told_in_one_line(leaf, arguments, part, capsys):
    assert main(["lineage", leaf, *arguments]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert part in line


def test_what_the_model_does_not_record_of_an_areole_is_not_told_as_none(leaf, capsys):
    told = json.loads(output(["lineage", leaf, "--areole", "0", "--json"], capsys))
    names = ("sources", "drained", "blind_ends", "area_at_birth", "area_at_end")
    assert [told[name] for name in names] == [None] * 5
    said = output(["lineage", leaf, "--areole", "0"], capsys)
    assert said.count("not recorded") == 3


def test_a_stem_has_tables_of_its_veins_and_no_areoles(tmp_path, capsys):
    (tmp_path / "stem.toml").write_text(STEM)
    run = str(tmp_path / "stem.h5")
    assert main(["run", str(tmp_path / "stem.toml"), "-o", run, "--no-figure", "-q"]) == 0
    capsys.readouterr()
    births = json.loads(output(["lineage", run, "--births", "--json"], capsys))
    assert births["found"] > 0
    for option in (["--genealogy"], ["--loop", "0"], ["--areole", "0"]):
        assert main(["lineage", run, *option]) == 2
        assert "is a stem" in capsys.readouterr().err
    assert main(["lineage", run, "--at", "0,10"]) == 2
    assert "a place of two numbers is one of a blade" in capsys.readouterr().err


def test_the_median_life_stands_above_the_life_table(leaf, capsys):
    with Timeline(leaf) as timeline:
        median = timeline.lineage.median_life()
    first = output(["lineage", leaf, "--life-table"], capsys).splitlines()[0]
    assert first.startswith(f"median life: {median.age} steps (95 % interval {median.low} to ")
    told = json.loads(output(["lineage", leaf, "--life-table", "--json"], capsys))["median"]
    assert (told["age"], told["n"]) == (median.age, median.n)
    not_yet = said(replace(median, age=None, n=4, deaths=1, censored=3, least_survival=0.75))
    assert "not reached, 0.75 live on" in not_yet


@pytest.mark.parametrize(
    ("low", "high", "words"),
    [
        (None, None, "(without a 95 % interval)"),
        (2, None, "(95 % interval from 2 on, without an upper end)"),
        (None, 9, "(95 % interval up to 9, without a lower end)"),
        (2, 9, "(95 % interval 2 to 9)"),
    ],
)
def test_the_median_life_is_said_in_whole_words(low, high, words):
    one = MedianLife(1, low, high, n=1, deaths=1, censored=0, least_survival=0.0)
    assert (
        said(one) == f"median life: 1 step {words}; 1 source: 1 removed, 0 alive at the last step"
    )


def test_people_are_shown_the_beginning_of_a_long_table(leaf, monkeypatch, capsys):
    monkeypatch.setattr(lineage_tables, "LONGEST_TABLE", 7)
    n_rows = json.loads(output(["lineage", leaf, "--fates", "--json"], capsys))["found"]
    assert n_rows > 7
    lines = output(["lineage", leaf, "--fates"], capsys).splitlines()
    assert len(lines) == 7 + 2
    assert lines[-1].startswith(f"... and {n_rows - 7:,} more (--limit N shows N rows")
    whole = output(["lineage", leaf, "--fates", "--limit", str(n_rows)], capsys).splitlines()
    assert len(whole) == n_rows + 1


def test_survival_is_drawn(leaf, tmp_path, capsys):
    picture = str(tmp_path / "survival.svg")
    assert "written" in output(["render", leaf, "-o", picture, "--survival"], capsys)
    assert main(["render", leaf, "-o", picture, "--force", "--survival", "--step", "3"]) == 2
    assert "takes no --step" in capsys.readouterr().err


@pytest.mark.parametrize("form", ["--genealogy", "--births"])
def test_lineage_is_drawn(leaf, form, tmp_path, capsys):
    pictures = []
    for name in ("first.png", "second.png"):
        assert "written" in output(["render", leaf, "-o", str(tmp_path / name), form], capsys)
        pictures.append((tmp_path / name).read_bytes())
    assert pictures[0] == pictures[1]
    young = str(tmp_path / "young.svg")
    assert "written" in output(["render", leaf, "-o", young, "--births", "--step", "9"], capsys)
    assert main(["render", leaf, "-o", str(tmp_path / "x.png"), form, "--unroll"]) == 2
    assert "exclude each other" in capsys.readouterr().err
    steps = ["--step", "1", "--step", "2"]
    assert main(["render", leaf, "-o", str(tmp_path / "x.png"), form, *steps]) == 2
    assert f"{form} shows one step" in capsys.readouterr().err
