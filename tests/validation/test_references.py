"""Numbers of papers and of ours, entered a second time: a change of one is noticed here."""

from dataclasses import asdict

from vasc.validation.arabidopsis import CRITERIA
from vasc.validation.references import (
    CITATIONS,
    FEATURES,
    N_LOOP_PAIRS,
    OBSERVED_SEQUENCE,
    SEQUENCE,
)


def test_thresholds_of_the_sequence():
    assert asdict(SEQUENCE) == {
        "half_way": (0.38, 0.62),
        "pair_time": 3.0,
        "mirrored": 0.02,
        "tip": 0.02,
        "minor_delay": 40.0,
        "formed_ratio": 1.0,
        "third_formed_ratio": 0.6,
        "third_final_ratio": (0.5, 2.0),
        "margin": 0.15,
        "midvein_span": 0.9,
        "midvein_straightness": 0.95,
        "unfinished_share": 0.1,
        "notch_depth": 0.01,
    }
    assert N_LOOP_PAIRS == 3


def test_numbers_of_ours_are_marked():
    ours = {row.id for row in CRITERIA if row.basis == "ours"}
    assert ours == {"C1", "C3", "C4", "C6", "C8", "C13", "C16", "C17", "C19"}
    assert {row.basis for row in CRITERIA} == {"thesis", "ours"}


def test_the_observed_sequence_names_its_sources():
    assert [one.number for one in OBSERVED_SEQUENCE] == list(range(1, len(OBSERVED_SEQUENCE) + 1))
    named = {source for one in OBSERVED_SEQUENCE for source in one.sources}
    assert named == set(CITATIONS)
    assert [one for one in OBSERVED_SEQUENCE if not one.sources] == []


def test_the_order_of_the_observed_events():
    assert [event for one in OBSERVED_SEQUENCE for event in one.events] == [
        *("tip_source", "midvein", "pair_1", "lower_halves", "upper_pair", "loop_1"),
        *("pair_2", "loop_2", "pair_3", "loop_3"),
        *("minor_in_loop_1", "minor_in_loop_2", "minor_in_loop_3"),
        *("mesophyll_event", "first_free_end"),
    ]


def test_the_features_of_the_wild_type():
    assert list(FEATURES) == ["a", "b", "c", "d"]
    assert "midvein along the whole leaf" in FEATURES["a"]
    assert "closed loops" in FEATURES["b"]
    assert "end freely or join" in FEATURES["c"]
    assert "scalloped" in FEATURES["d"]
