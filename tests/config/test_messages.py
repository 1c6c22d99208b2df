"""Every way to write a wrong config gives one line that names key, value and what is allowed."""

import pytest
from config.wrong_configs import WRONG, config

from vasc.config import load_text
from vasc.errors import ConfigError


def problems(text, folder=None):
    """Give the lines of a config that must be refused."""
    with pytest.raises(ConfigError) as caught:
        load_text(text, name="leaf", **({} if folder is None else {"folder": folder}))
    return caught.value.problems


@pytest.mark.parametrize("case", WRONG)
def test_a_wrong_config_is_told_in_one_line(case, tmp_path):
    text, *parts = WRONG[case]
    found = problems(text, tmp_path)
    fitting = [line for line in found if all(part in line for part in parts)]
    assert len(fitting) == 1, found
    for line in found:
        assert line.startswith("leaf: ")
        assert "\n" not in line
        assert line.isprintable()
        assert len(line) < 400
    assert list(tmp_path.iterdir()) == []


def test_the_sound_config_is_sound():
    assert load_text(config()).parameters.seed == 1


def test_all_problems_are_told_at_once():
    found = problems(
        config(
            top='kind = "closed"\nsead = 1\nseed = "x"',
            domain='shape = "ovat"',
            growth='kind = "none"\nfinal_length = inf',
            placement='kind = "given"\nfile = "none.csv"',
            arrival="kill_distance = -1",
        )
    )
    keys = ["sead", "seed", "domain.shape", "domain.length", "growth.final_length"]
    keys += ["arrival.kill_distance", "placement.file"]
    for key in keys:
        assert len([line for line in found if line.startswith(f"leaf: {key}")]) == 1, (key, found)
    assert len(found) == len(keys)


@pytest.mark.parametrize(
    ("tables", "wrong", "right"),
    [
        ({"domain": 'shape = "ovate"\nlenght = 20.0'}, "domain.lenght", "length"),
        (
            {"growth": 'kind = "marginal"\nfinal_lenght = 60.0\nlength_per_step = 2.0'},
            "growth.final_lenght",
            "final_length",
        ),
        ({"arrival": None, "arival": "kill_distance = 1.0"}, "arival", "arrival"),
    ],
)
def test_a_misspelt_key_is_not_missing_as_well(tables, wrong, right):
    (line,) = problems(config(**tables))
    assert line.startswith(f"leaf: {wrong} = ")
    assert line.endswith(f'; nearest: "{right}"')


def test_a_missing_key_is_told_beside_an_unknown_one_that_is_not_like_it():
    found = problems(config(domain='shape = "ovate"\nqqq = 1'))
    assert [line.partition(":")[2].split()[0].rstrip(":") for line in found] == [
        "domain.length",
        "domain.qqq",
    ]


def test_problems_beside_an_unknown_kind_are_told_if_every_model_has_them():
    found = problems(
        config(top='kind = "x"\nseed = -1', arrival="kill_distance = -1", stop="steps = 0")
    )
    # no stem has an arrival
    assert [line.partition(" = ")[0] for line in found] == [
        "leaf: kind",
        "leaf: seed",
        "leaf: stop.steps",
    ]


def test_a_long_value_is_shortened():
    (line,) = problems(config(top='kind = "closed"\nseed = "' + "x" * 5000 + '"'))
    assert len(line) < 150
    assert " ... " in line


def test_a_text_cannot_steer_the_terminal():
    (line,) = problems(config(top='kind = "closed"\nseed = "\\u001b[31m\\u009b2J\\n"'))
    assert line.isprintable()
    assert '"\\u001b[31m\\u009b2J\\n"' in line
