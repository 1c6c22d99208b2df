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


def test_problems_beside_an_unknown_kind_are_told_if_every_model_has_them():
    found = problems(
        config(top='kind = "x"', arrival="kill_distance = -1", perception='kind = "nearest"')
    )
    assert [line.partition(" = ")[0] for line in found] == [
        "leaf: kind",
        "leaf: arrival.kill_distance",
    ]


def test_a_long_value_is_shortened():
    (line,) = problems(config(top='kind = "closed"\nseed = "' + "x" * 5000 + '"'))
    assert len(line) < 150
    assert " ... " in line


def test_a_text_cannot_steer_the_terminal():
    (line,) = problems(config(top='kind = "closed"\nseed = "\\u001b[31m\\u009b2J\\n"'))
    assert line.isprintable()
    assert '"\\u001b[31m\\u009b2J\\n"' in line
