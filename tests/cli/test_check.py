"""``vasc check sequence``: exit codes, figures for scripts and people, and the picture."""

import json

import pytest

from vasc.cli import main


@pytest.fixture(scope="module")
def leaf(recorded):
    """Give a recorded run whose sources come at random."""
    return str(recorded / "leaf.h5")


def test_a_criterion_that_fails_ends_with_one(leaf, capsys):
    assert main(["check", "sequence", leaf, "--json"]) == 1
    said = capsys.readouterr()
    assert said.err == ""
    found = json.loads(said.out)
    assert found["pass"] is False
    assert found["failures"]
    assert found["files"] == []
    assert len(found["criteria"]) == 21


def test_people_read_verdicts_and_reasons(leaf, capsys):
    assert main(["check", "sequence", leaf]) == 1
    text = capsys.readouterr().out
    assert "C1    FAIL" in text
    assert "C20   open" in text
    assert "no event of mesophyll differentiation is recorded" in text
    assert "measured as" in text
    assert "criteria pass" in text


@pytest.mark.parametrize("suffix", ["png", "svg"])
def test_the_picture(leaf, suffix, tmp_path, capsys):
    picture = tmp_path / f"events.{suffix}"
    assert main(["check", "sequence", leaf, "-o", str(picture)]) == 1
    first = picture.read_bytes()
    assert len(first) > 1000
    assert main(["check", "sequence", leaf, "-o", str(picture)]) == 2
    assert "exists already" in capsys.readouterr().err
    assert main(["check", "sequence", leaf, "-o", str(picture), "--force"]) == 1
    assert picture.read_bytes() == first


@pytest.mark.parametrize(
    ("arguments", "part"),
    [
        (["check", "sequence", "none.h5"], "none.h5"),
        (["check", "sequence"], "RUN.h5"),
        (["check", "order", "none.h5"], "No such command 'order'"),
    ],
)
def test_bad_input_ends_with_two(arguments, part, here, capsys):
    assert main(arguments) == 2
    assert part in capsys.readouterr().err


def test_a_picture_of_no_known_kind_is_refused_before_the_run_is_read(here, capsys):
    assert main(["check", "sequence", "none.h5", "-o", "events.txt"]) == 2
    assert "suffix '.txt'" in capsys.readouterr().err


def test_the_help_shows_examples(capsys):
    assert main(["check", "--help"]) == 0
    assert "vasc check sequence" in capsys.readouterr().out
    assert main(["check", "sequence", "--help"]) == 0
    text = capsys.readouterr().out
    assert "Examples:" in text
    assert "--json" in text
