"""What ``vasc show`` says on where the equations of a run are from."""

import json

import pytest

from vasc.cli import main
from vasc.config import load_text
from vasc.experiment import run
from vasc.models import MODELS
from vasc.parameters import evidence

TISSUE = "[domain]\ncolumns = 5\nrows = 4\n"
CONFIGS = {
    "facilitated": 'kind = "canalization"\n[transport]\nkind = "facilitated"\n[veins]\n'
    "lines = [[[0.0, 0.0]]]\n[placement]\npoints = [[4.0, 3.0]]\n" + TISSUE,
    "up-the-gradient": 'kind = "up-the-gradient"\n' + TISSUE,
    "open": 'kind = "open"\n[domain]\nshape = "ovate"\nlength = 5.0\n'
    '[placement]\nkind = "given"\npoints = [[0.0, 3.0]]\n[arrival]\nkill_distance = 1.0\n',
}
SAID = {"facilitated": "[R]", "up-the-gradient": "[V]", "open": None}


@pytest.mark.parametrize("name", CONFIGS)
def test_show_says_where_the_equations_are_from(name, tmp_path, capsys):
    path = tmp_path / "run.h5"
    run(load_text(CONFIGS[name]), path, steps=2)
    assert main(["show", str(path)]) == 0
    said = [line for line in capsys.readouterr().out.splitlines() if "equations: " in line]
    assert main(["show", str(path), "--json"]) == 0
    shown = json.loads(capsys.readouterr().out)["evidence"]
    assert said == [f"equations: {sentence}" for sentence in shown]
    if SAID[name] is None:
        assert shown == []
    else:
        assert shown[0].startswith(SAID[name])


def test_every_model_of_the_literature_beside_the_thesis_has_a_mark():
    for kind in ("up-the-gradient", "constant-production", "gottlieb"):
        assert MODELS[kind].evidence.startswith(("[V]", "[C]", "[T]", "[R]"))
    assert evidence(load_text(CONFIGS["facilitated"]).parameters) != []
