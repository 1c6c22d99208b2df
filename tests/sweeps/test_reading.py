"""A wrong sweep file ends with a line a problem and exit code 2, before anything is made."""

import pytest
from sweeps.sweep_files import SHORT, write

from vasc.cli import main
from vasc.config.bundled import bundled_sweeps
from vasc.sweeps import MEASURES, load_sweep

WRONG = {
    "no base": ('base = "leaf.toml"', "", ["base: missing"]),
    "another base": ('"leaf.toml"', '"laef.toml"', ['base = "laef.toml"', "no such file"]),
    "an unknown key": ("seed = 5", "sede = 5", ["sede = 5: unknown key", 'nearest: "seed"']),
    "a text for a number": ("seed = 5", 'seed = "5"', ['seed = "5"', "a whole number"]),
    "no replicates": ("replicates = 2", "replicates = 0", ["replicates = 0", "at least 1"]),
    "no measures": (
        'measures = ["summary.nodes", "stats.vein_density", "lineage.source_life_mean"]',
        "measures = []",
        ["measures = []", "at least 1"],
    ),
    "a measure of no group": (
        "summary.nodes",
        "nodes",
        ['measures[0] = "nodes"', "stats.KEY", "check.sequence.KEY"],
    ),
    "a misspelt measure": (
        "stats.vein_density",
        "stats.vein_densety",
        ["measures[1]", 'nearest: "stats.vein_density"'],
    ),
    "a measure twice": ("stats.vein_density", "summary.nodes", ["measures[1]", "twice"]),
    "an unknown figure": (
        "seed = 5",
        'figure = "bars"',
        ['figure = "bars"', '"curves", "pictures"'],
    ),
    "an axis that is no list": ("= [1.0, 3.0]", "= 1.0", ["arrival.kill_distance", "a list"]),
    "an axis without values": ("= [1.0, 3.0]", "= []", ["arrival.kill_distance", "one or more"]),
    "an axis of the seed": ("arrival.kill_distance", "seed", ["axes.seed", "replicates"]),
    "a key that is none": ("arrival.kill_distance", '"a b"', ['"a b"', "dotted key"]),
    "a range without a number of values": (
        "[1.0, 3.0]",
        "{ from = 1.0, to = 3.0 }",
        ["kill_distance", "num: missing"],
    ),
    "an unknown scale": (
        "[1.0, 3.0]",
        '{ from = 1.0, to = 3.0, num = 3, scale = "lin" }',
        ['scale = "lin"', '"linear", "log"'],
    ),
    "ends that no number is between": (
        "[1.0, 3.0]",
        "{ from = -1.7e308, to = 1.7e308, num = 3 }",
        ["from -1.7e+308 to 1.7e+308", "farther than numbers reach"],
    ),
    "a logarithm of zero": (
        "[1.0, 3.0]",
        '{ from = 0.0, to = 3.0, num = 3, scale = "log" }',
        ["greater than 0"],
    ),
    "a key that the config has not": (
        "kill_distance",
        "kill_distanze",
        ["arrival.kill_distanze", 'nearest: "kill_distance"'],
    ),
    "a value out of range": (
        "[1.0, 3.0]",
        "[1.0, -3.0]",
        ["arrival.kill_distance = -3.0", "greater than 0"],
    ),
    "a key below a value": (
        "arrival.kill_distance",
        "kind.more",
        ["kind is not a table in this config"],
    ),
    "too many runs": ("replicates = 2", "replicates = 99999", ["at most 100,000"]),
    "a date": ("seed = 5", "seed = 2020-01-01", ["seed = 2020-01-01", "date"]),
    "no TOML": ("seed = 5", "seed = ", ["line 3", "not TOML"]),
}


@pytest.mark.parametrize("case", WRONG)
def test_a_wrong_sweep_is_refused(case, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    old, new, parts = WRONG[case]
    assert old in SHORT
    write(tmp_path, SHORT.replace(old, new, 1))
    assert main(["sweep", "small.toml", "-o", "out"]) == 2
    said = capsys.readouterr()
    assert said.out == ""
    lines = said.err.splitlines()
    assert all(line.startswith("small.toml: ") for line in lines), lines
    assert len([line for line in lines if all(part in line for part in parts)]) == 1, lines
    assert not (tmp_path / "out").exists()


def test_a_grid_may_have_corners_that_cannot_be_made(tmp_path):
    text = SHORT.replace("arrival.kill_distance = [1.0, 3.0]", "domain.length = [20.0, 60.0]")
    path = write(tmp_path, text.replace("placement.density", "growth.final_length"))
    text = path.read_text().replace("[0.01, 0.03]", "[50.0, 90.0]")
    path.write_text(text)
    assert len(load_sweep(path).runs) == 8
    # no final length is left for a blade of 100
    path.write_text(text.replace("[20.0, 60.0]", "[20.0, 100.0]"))
    with pytest.raises(Exception, match="final_length"):
        load_sweep(path)


def test_dotted_and_quoted_keys_are_one(tmp_path):
    path = write(tmp_path)
    dotted = load_sweep(path).parameters
    quoted = SHORT.replace("arrival.kill_distance", '"arrival.kill_distance"')
    path.write_text(quoted)
    assert load_sweep(path).parameters == dotted


def test_the_base_is_found_beside_the_sweep(tmp_path, monkeypatch):
    (tmp_path / "elsewhere").mkdir()
    path = write(tmp_path)
    monkeypatch.chdir(tmp_path / "elsewhere")
    assert load_sweep(path).folder == str(tmp_path)


@pytest.mark.parametrize(
    ("changes", "part"),
    [
        (
            [
                ('"leaf.toml"', '"stem-golden-2-3-r35"'),
                ("arrival.kill_distance", "domain.radius"),
                ("placement.density", "placement.rise"),
                ("[0.01, 0.03]", "[10.0]"),
                ("[1.0, 3.0]", "[30.0, 35.0]"),
            ],
            "not stems",
        ),
        ([("arrival.kill_distance = [1.0, 3.0]\nplacement.density = [0.01, 0.03]", "")], "axes"),
    ],
    ids=["stems", "no axes"],
)
def test_a_grid_of_pictures_needs_leaves_and_axes(changes, part, tmp_path):
    text = SHORT.replace("seed = 5", 'figure = "pictures"')
    for old, new in changes:
        text = text.replace(old, new)
    with pytest.raises(Exception, match=part):
        load_sweep(write(tmp_path, text))


@pytest.mark.parametrize("bundled", bundled_sweeps(), ids=lambda one: one.name)
def test_a_bundled_sweep_is_sound(bundled):
    sweep = load_sweep(bundled.name)
    assert sweep.parameters.title == bundled.title != ""
    assert sweep.parameters.reference
    assert sweep.folder is None
    assert set(sweep.parameters.measures) <= set(MEASURES)


def test_there_are_three_bundled_sweeps():
    assert [one.name for one in bundled_sweeps()] == [
        "arabidopsis-birth-distance",
        "kill-distance-by-darts",
        "stem-radius-over-rise",
    ]


def test_a_misspelt_bundled_sweep_is_told_with_the_nearest(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert main(["sweep", "kill-distance-by-dart"]) == 2
    assert "nearest: kill-distance-by-darts" in capsys.readouterr().err
