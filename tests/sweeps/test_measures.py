"""The catalogue of measures is what the analyses say, and a measure is their number."""

import dataclasses
import json
import shutil

import pytest

from vasc import experiment
from vasc.analysis import statistics
from vasc.cli.show import described
from vasc.config import load
from vasc.sweeps.measures import (
    CATALOGUE,
    CONNECTIVITY,
    CRITERIA,
    EVENTS,
    MEASURES,
    SEQUENCE,
    STATISTICS,
    STRAND,
    measure,
    name_problem,
)
from vasc.timeline import Timeline
from vasc.validation import arabidopsis
from vasc.validation.strands import check_strand


@pytest.fixture(scope="module")
def leaf(tmp_path_factory, short):
    """Open a recorded leaf."""
    path = tmp_path_factory.mktemp("leaf") / "leaf.h5"
    shutil.copy(short / "runs" / "0001.h5", path)
    with Timeline(path) as timeline:
        yield timeline


@pytest.fixture(scope="module")
def stem(tmp_path_factory):
    """Record a small stem and open it."""
    path = tmp_path_factory.mktemp("stem") / "stem.h5"
    changes = [(("placement", "rise"), 10.0), (("domain", "radius"), 12.0)]
    changes += [(("placement", "plastochron"), 5), (("placement", "primordia"), 29)]
    experiment.run(load("stem-golden-1-1-r12", changes), path)
    with Timeline(path) as timeline:
        yield timeline


def test_all_statistics_are_in_the_catalogue(leaf):
    known = {name.partition(".")[0] for name in STATISTICS}
    assert set(statistics(leaf.frame())) == known


def test_all_of_a_stem_that_is_no_table_is_in_the_catalogue(stem):
    from vasc.validation.stem_phyllotaxis import check_connectivity, reading

    report = check_connectivity(reading.read_stem(stem)).as_json()
    assert set(CONNECTIVITY) <= set(report)
    left = set(report) - set(CONNECTIVITY)
    assert left == {"radius_range", "judged", "interval", "tie", "parastichies", "table"}


def test_the_criteria_and_features_are_those_of_the_sequence():
    assert {criterion.id for criterion in arabidopsis.CRITERIA} == set(CRITERIA)
    assert len(EVENTS) == len(set(EVENTS))


def test_every_measure_of_a_leaf_is_a_plain_value(leaf):
    others = ("check.connectivity", "check.strand")
    names = [name for name in MEASURES if not name.startswith(others)]
    values, problems = measure(leaf, names)
    assert list(values) == names
    json.dumps(values, allow_nan=False)
    assert [line for line in problems if not line.startswith("check.sequence")] == []
    report = arabidopsis.check_sequence(leaf).as_json()
    for key in SEQUENCE[:6]:
        assert values[f"check.sequence.{key}"] == report[key]
    for event in report["events"]:
        assert values[f"check.sequence.step_of.{event['name']}"] == event["step"]
    for row in report["criteria"]:
        assert values[f"check.sequence.criteria.{row['id']}"] == row["passed"]


def test_the_summary_is_what_show_and_run_say(leaf):
    values, _ = measure(leaf, [f"summary.{name}" for name in CATALOGUE["summary"]])
    found = {name.partition(".")[2]: value for name, value in values.items()}
    shown = described(leaf)
    said = dataclasses.asdict(experiment.resume(leaf.path))
    for name, other in (("steps", "steps"), ("time", "time"), ("complete", "complete")):
        assert found[name] == shown[other]
    for name in ("nodes", "segments", "sources_placed", "sources_left", "joins", "loops"):
        assert found[name] == said[name]
    assert found["stop_reason"] == said["stop_reason"]


def test_lives_of_sources_are_those_of_their_fates(leaf):
    values, _ = measure(leaf, [f"lineage.{name}" for name in CATALOGUE["lineage"]])
    fates = [leaf.lineage.fate_of(source) for source in range(leaf.n_rows("sources"))]
    lives = [fate.removed - fate.birth for fate in fates if fate.removed >= 0]
    assert values["lineage.source_life_mean"] == pytest.approx(sum(lives) / len(lives))
    assert values["lineage.sources_unreached"] == len(fates) - len(lives)
    caused = sum(len(fate.nodes) for fate in fates)
    assert values["lineage.nodes_per_source"] == pytest.approx(caused / len(fates))
    assert values["lineage.source_life_median"] in lives


def test_a_stem_has_pairs_and_numbers_of_links(stem):
    names = ["check.connectivity.pair", "check.connectivity.links", "check.connectivity.pass"]
    values, problems = measure(stem, [*names, "stats.blade_area"])
    assert problems == []
    assert values[names[0]] == [1, 1]
    assert values[names[1]] > 20
    assert values[names[2]] is True
    assert values["stats.blade_area"] is None


def test_a_strand_is_measured_as_it_is_checked(tmp_path):
    experiment.run(load("mitchison-two-sinks-left"), tmp_path / "canals.h5")
    names = [name for name in MEASURES if name.startswith(("check.strand", "stats", "summary"))]
    with Timeline(tmp_path / "canals.h5") as timeline:
        values, problems = measure(timeline, names)
        report = check_strand(timeline).as_json()
    assert problems == []
    assert set(report) - set(STRAND) == {"end_node", "activation", "thresholds"}
    assert values["check.strand.pass"] is report["pass"]
    assert values["check.strand.tortuosity"] == report["tortuosity"]
    assert values["check.strand.sinks"] == len(report["sinks"])
    json.dumps(values, allow_nan=False)


def test_what_cannot_be_measured_is_a_line_without_the_place_of_the_run(leaf):
    values, problems = measure(leaf, ["check.connectivity.pair", "summary.nodes"])
    assert values["check.connectivity.pair"] is None
    assert values["summary.nodes"] > 0
    (line,) = problems
    assert line.startswith("check.connectivity: ")
    assert str(leaf.path.parent) not in line


@pytest.mark.parametrize("name", MEASURES)
def test_a_known_name_has_no_problem(name):
    assert name_problem(name) == ""
