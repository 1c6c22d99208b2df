"""Given sources: points or a file, births, and what is refused with the reason."""

import numpy as np
import pytest
from pydantic import ValidationError

from vasc.errors import ConfigError
from vasc.models import OpenVenation
from vasc.placement.given import GivenParameters, read_sources
from vasc.simulation import simulate
from vasc.streams import Streams

GROWTHS = {
    "none": {"kind": "none"},
    "marginal": {"kind": "marginal", "final_length": 40.0, "length_per_step": 2.0},
    "isogonic": {"kind": "isogonic", "final_length": 40.0, "length_per_step": 2.0},
}


def run(placement, folder, growth="none"):
    """The last state of a run on a round blade 20 D long."""
    config = {
        "domain": {"shape": "orbicular", "length": 20.0},
        "growth": GROWTHS[growth],
        "placement": {"kind": "given", **placement},
        "arrival": {"kill_distance": 1.0},
    }
    *_, last = simulate(OpenVenation.model_validate(config).model(folder), Streams(1))
    return last


def test_points_appear_in_the_first_step(tmp_path):
    points = [(0.0, 10.0), (3.0, 4.0), (-2.0, 15.0)]
    state = run({"points": points}, tmp_path)
    assert state.rows("sources", "position").tolist() == [list(p) for p in points]
    assert state.rows("sources", "birth").tolist() == [1, 1, 1]
    assert (state.rows("sources", "cause") == 1).all()
    assert len(state.live) == 0


@pytest.mark.parametrize("growth", GROWTHS)
def test_sources_are_born_in_their_step_and_at_their_place(tmp_path, growth):
    points, births = [(0.0, 10.0), (3.0, 4.0), (-2.0, 15.0), (1.0, 18.0)], [5, 1, 12, 5]
    state = run({"points": points, "births": births}, tmp_path, growth)
    assert state.rows("sources", "birth").tolist() == [1, 5, 5, 12]
    places = [[3.0, 4.0], [0.0, 10.0], [1.0, 18.0], [-2.0, 15.0]]
    np.testing.assert_allclose(state.rows("sources", "position"), places, rtol=1e-15)
    scale = [1.1, 1.5, 1.5, 2.0] if growth == "isogonic" else [1.0] * 4
    material = np.array(places) / np.array(scale)[:, None]
    np.testing.assert_allclose(state.rows("sources", "material"), material, rtol=1e-14)
    assert state.step >= 12


def test_a_file_says_the_same_as_points(tmp_path):
    (tmp_path / "sources.csv").write_text("y,x,birth\n10,0,3\n4,3.5,\n15,-2,1\n")
    points, births = read_sources(tmp_path / "sources.csv")
    assert points.tolist() == [[0.0, 10.0], [3.5, 4.0], [-2.0, 15.0]]
    assert births.tolist() == [3, 1, 1]
    from_file = run({"file": "sources.csv"}, tmp_path)
    given = run({"points": points.tolist(), "births": births.tolist()}, tmp_path)
    assert (
        from_file.rows("nodes", "position").tobytes() == given.rows("nodes", "position").tobytes()
    )
    assert from_file.rows("sources", "birth").tolist() == [1, 1, 3]


def test_births_are_optional_in_a_file(tmp_path):
    (tmp_path / "sources.csv").write_text("x,y\n0,10\n")
    assert read_sources(tmp_path / "sources.csv")[1].tolist() == [1]


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("x,y\n1,2\n3,north\n", "line 3"),
        ("x,y\n1\n", "line 2"),
        ("east,north\n1,2\n", "columns x, y"),
        ("x,y,birth\n1,2,1.5\n", "line 2"),
        ("x,y,birth\n1,2,0\n", "line 2 .* the birth is 0; it must be a step from 1 to 1,000,000"),
        (f"x,y,birth\n1,2,{10**20}\n", "line 2 .* the birth is 1e"),
        (f"x,y\n1,{'2' * 200_000}\n", "field larger than field limit"),
        ("x,y\n", "holds no sources"),
        ("", "holds no sources"),
    ],
)
def test_bad_files_are_refused_with_the_line(tmp_path, text, message):
    (tmp_path / "sources.csv").write_text(text)
    with pytest.raises(ConfigError, match=message):
        read_sources(tmp_path / "sources.csv")


@pytest.mark.parametrize("value", ["nan", "inf"])
def test_numbers_that_are_not_finite_are_refused(tmp_path, value):
    (tmp_path / "sources.csv").write_text(f"x,y\n1,2\n{value},3\n")
    with pytest.raises(Exception, match="finite") as refusal:
        run({"file": "sources.csv"}, tmp_path)
    assert "placement.file" in str(refusal.value)


def test_missing_and_binary_files_are_refused_by_name(tmp_path):
    with pytest.raises(ConfigError, match=r"cannot read .*nowhere\.csv"):
        read_sources(tmp_path / "nowhere.csv")
    with pytest.raises(ConfigError, match="cannot read"):
        read_sources(tmp_path)
    (tmp_path / "picture.csv").write_bytes(b"\x89PNG\xff\xfe\x00")
    with pytest.raises(ConfigError, match="cannot read"):
        read_sources(tmp_path / "picture.csv")


@pytest.mark.parametrize(
    ("placement", "message"),
    [
        ({}, "give either"),
        ({"points": [(0.0, 1.0)], "file": "a.csv"}, "give either"),
        ({"points": []}, "at least 1"),
        ({"points": [(0.0, 1.0)], "births": [1, 2]}, "one step for each"),
        ({"points": [(0.0, 1.0)], "births": [0]}, "the first step is 1"),
        ({"file": "a.csv", "births": [1]}, "one step for each"),
        ({"points": [(0.0, float("nan"))]}, "finite"),
    ],
)
def test_bad_tables_are_refused(placement, message):
    with pytest.raises(ValidationError, match=message):
        GivenParameters.model_validate({"kind": "given", **placement})


def test_sources_must_lie_in_the_blade_of_their_step(tmp_path):
    # the blade has grown to 30 D in step 5, and a source may be born near its tip then
    assert run({"points": [(0.0, 28.0)], "births": [5]}, tmp_path, "marginal").step >= 5
    for births in ([4], [1]):
        with pytest.raises(ConfigError, match=r"\(0, 29\) lies outside the blade of step"):
            run({"points": [(0.0, 29.0)], "births": births}, tmp_path, "marginal")
