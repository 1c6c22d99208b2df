"""The picture of the events beside the observed sequence."""

import re

import pytest

from vasc.errors import OutputError
from vasc.render import draw_sequence
from vasc.render.sequence import BACKWARD, FORWARD


def report(*steps):
    """Give what a picture needs of a report: events a, b, ... at these steps."""
    names = [f"event_{letter}" for letter in "abcdef"]
    return {
        "run": {"file": "run.h5", "steps": 100},
        "observed": [
            {"number": 1, "words": "the first", "sources": ["Paper 2000"], "events": names[:2]},
            {"number": 2, "words": "the second", "sources": ["Paper 2001"], "events": names[2:3]},
        ],
        "events": [
            {"name": name, "step": step, "leaf_length": 10.0}
            for name, step in zip(names, steps, strict=False)
        ],
        "criteria": [{"passed": True}, {"passed": None}],
        "failures": [],
    }


def drawn(found, tmp_path):
    """Draw as svg and give its text."""
    return draw_sequence(found, tmp_path / "events.svg").read_text()


def test_events_in_order_are_joined_by_one_colour(tmp_path):
    text = drawn(report(1, 2, 50), tmp_path)
    assert len(re.findall(FORWARD, text)) == 2
    assert BACKWARD not in text


def test_an_event_that_is_early_is_seen(tmp_path):
    text = drawn(report(10, 20, 5), tmp_path)
    assert len(re.findall(BACKWARD, text)) == 1


def test_events_that_did_not_occur_leave_no_mark(tmp_path):
    all_of_them, one = drawn(report(1, 2, 3), tmp_path), drawn(report(1), tmp_path)
    assert FORWARD not in one
    assert len(one) < len(all_of_them)


def test_equal_reports_give_equal_bytes(tmp_path):
    assert drawn(report(1, 2, 50), tmp_path) == drawn(report(1, 2, 50), tmp_path)


def test_a_picture_of_no_known_kind_is_refused(tmp_path):
    with pytest.raises(OutputError, match="suffix"):
        draw_sequence(report(1), tmp_path / "events.txt")
