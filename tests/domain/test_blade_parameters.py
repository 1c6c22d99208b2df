"""The [domain] table: from keys to a blade, and one line for what is wrong with it."""

import re
import subprocess
import sys
import tomllib
from pathlib import Path

import numpy as np
import pytest
import shapely
from pydantic import ValidationError

from vasc.domain import SHAPES, BladeParameters
from vasc.domain.normalization import smoothed
from vasc.errors import OutlineError

ROOT = Path(__file__).resolve().parents[2]
PAGE = (ROOT / "docs" / "blades.md").read_text()
BOX = [(-0.5, 0.0), (0.5, 0.0), (0.5, 2.0), (-0.5, 2.0)]


def blade(folder=Path(), **table):
    return BladeParameters(**{"length": 10.0, **table}).blade(folder)


@pytest.mark.parametrize("name", sorted(SHAPES))
def test_every_named_shape_makes_a_blade_of_its_length(name):
    found = blade(shape=name, length=37.5)
    assert found.length == 37.5
    assert found.seeds.tolist() == [[0.0, 0.0]]
    assert 300 < len(blade(shape=name, curve_points=640).rings[0]) < 700


def test_width_stretches_any_outline():
    assert blade(shape="lobed", width=0.4).width == pytest.approx(4.0)
    assert blade(points=BOX, width=3.0).bounds == (-15.0, 0.0, 15.0, 10.0)


def test_parameters_reach_the_shape():
    deep = blade(shape="cordate", parameters={"sinus": 0.3})
    assert deep.bounds[1] == pytest.approx(-3.0, abs=0.01)
    assert BladeParameters(shape="ovate", length=1.0).parameters == SHAPES["ovate"]()


def test_a_blade_is_the_same_in_every_size():
    small, large = (blade(shape="bilobed", length=length) for length in (1.0, 64.0))
    assert np.array_equal(small.rings[0] * 64.0, large.rings[0])


def test_points_are_in_any_unit_and_hang_on_the_origin_or_where_said():
    expected = [[-2.5, 0.0], [2.5, 0.0], [2.5, 10.0], [-2.5, 10.0]]
    assert blade(points=BOX).rings[0].tolist() == expected
    moved = [(x + 7.0, y - 3.0) for x, y in BOX]
    assert blade(points=moved, attachment="lowest").rings[0].tolist() == expected
    assert blade(points=moved, attachment=(7.0, -3.0)).rings[0].tolist() == expected
    sideways = [(y, -x) for x, y in BOX]
    turned = blade(points=sideways, tip=(2.0, 0.0)).rings[0]
    np.testing.assert_allclose(turned, expected, atol=1e-9)


def test_a_file_is_looked_for_beside_the_config(tmp_path):
    (tmp_path / "box.csv").write_text("\n".join(f"{x},{y}" for x, y in BOX))
    assert blade(tmp_path, file="box.csv").area == pytest.approx(50.0)


def test_seeds_in_a_row_stand_in_the_middle_of_their_shares():
    found = blade(shape="linear", seeds={"count": 4, "height": 0.3}, width=0.4)
    np.testing.assert_allclose(found.seeds[:, 1], 3.0)
    np.testing.assert_allclose(found.seeds[:, 0], [-1.5, -0.5, 0.5, 1.5], atol=1e-9)
    assert found.contains(found.seeds).all()
    assert len(blade(shape="linear", seeds={"count": 30}).seeds) == 30


def test_each_part_may_be_seeded_at_its_lowest_point(tmp_path):
    box, hole = "0 0, 4 0, 4 5, 0 5, 0 0", "1 1, 1 4, 3 4, 3 1, 1 1"
    beside = "6 1, 7 0, 8 1, 7 5, 6 1"
    (tmp_path / "ab.wkt").write_text(f"MULTIPOLYGON ((({box}), ({hole})), (({beside})))")
    found = blade(tmp_path, file="ab.wkt", attachment=(4.0, 0.0), seeds="lowest", length=5.0)
    np.testing.assert_allclose(found.seeds, [[-4.0, 0.0], [3.0, 0.0]], atol=1e-9)
    with pytest.raises(OutlineError, match=r"^domain.seeds: none in the part \(ring 2\)"):
        blade(tmp_path, file="ab.wkt", attachment=(4.0, 0.0), seeds=[(0.0, 0.0)])


def test_several_outlines_in_a_file_are_told_in_its_own_coordinates(tmp_path):
    paths = ("M10 190 L60 190 L35 10 Z M30 150 L40 150 L35 140 Z", "M110 190 L160 190 L135 20 Z")
    drawn = "".join(f'<path d="{path}"/>' for path in paths)
    (tmp_path / "two.svg").write_text(f'<svg xmlns="http://www.w3.org/2000/svg">{drawn}</svg>')
    with pytest.raises(OutlineError) as error:
        blade(tmp_path, file="two.svg")
    assert str(error.value).startswith(
        'domain.file = "two.svg": the file has 2 outlines, from (10, 10) to (60, 190),'
        " from (110, 20) to (160, 190); draw one path, or join them;"
    )
    assert len(blade(tmp_path, file="two.svg", seeds="lowest").rings) == 3


def test_smoothing_passes_through_every_corner_without_kinks():
    angles = np.arange(9) * 2.0 * np.pi / 9
    corners = np.stack([np.sin(angles), 1.0 - np.cos(angles)], axis=1)
    curve = smoothed(corners, 900)
    for corner in corners:
        assert np.abs(curve - corner).max(axis=1).min() < 1e-14
    steps = np.roll(curve, -1, axis=0) - curve
    steps /= np.sqrt((steps * steps).sum(axis=1))[:, None]
    turns = (steps * np.roll(steps, -1, axis=0)).sum(axis=1)
    assert turns.min() > np.cos(np.radians(2.0))
    radii = np.sqrt(((curve - [0.0, 1.0]) ** 2).sum(axis=1))
    np.testing.assert_allclose(radii, 1.0, atol=0.01)


def test_smoothing_makes_no_loops_where_corners_are_uneven():
    ring = np.array([[0, 0], [1, 0], [1.001, 0.001], [3, 4], [2.99, 4.01], [0, 5], [-0.01, 0.2]])
    assert shapely.LinearRing(smoothed(ring, 500)).is_simple


def test_the_real_leaf_can_be_used():
    found = blade(
        ROOT / "configs",
        file="outlines/arabidopsis-rosette-leaf.csv",
        attachment="origin",
        smooth=True,
        length=200.0,
    )
    assert found.length == 200.0
    assert 300 < len(found.rings[0]) < 400
    # nearly round, on a petiole of a third of its length
    assert 0.55 < found.width / found.length < 0.75
    assert found.contains([[0.0, 120.0]]).all()


def test_rounded_coordinates_lie_on_a_fine_grid():
    ring = blade(shape="lobed", length=1.0).rings[0] * 2.0**40
    assert np.array_equal(ring, np.round(ring))


REFUSED = {
    "crossing points": (
        {"points": [(0, 0), (4, 4), (4, 1), (0, 4)]},
        "domain.points: crosses or touches itself at (2.28571, 2.28571); margins must not meet",
    ),
    "repeated point": ({"points": [(0, 0), (1, 1), (1, 1), (0, 1)]}, "domain.points: rows 1 and 2"),
    "no points": ({"points": []}, "domain.points: 0 points; it needs at least 3"),
    "two points": ({"points": [(0, 0), (1, 1)]}, "domain.points: 2 points; it needs at least 3"),
    "line": ({"points": [(0, 0), (1, 1), (2, 2)]}, "domain.points: area 0"),
    "missing file": ({"file": "none.csv"}, 'domain.file = "none.csv": cannot be read: No such'),
    "unknown file": ({"file": "leaf.doc"}, "domain.file = \"leaf.doc\": a file ending in '.doc'"),
    "seed outside": (
        {"shape": "ovate", "seeds": [(2.0, 0.5)]},
        "domain.seeds[0] = (2, 0.5): outside the outline, 1.",
    ),
    "attachment outside": (
        {"points": [(1, 0), (2, 0), (1, 1)]},
        "domain.seeds[0] = (0, 0): outside",
    ),
    "nothing above": (
        {"points": [(-1, -2), (1, -2), (0, 0)]},
        "domain.attachment (0, 0): no point of the outline is above it",
    ),
    "tip is attachment": (
        {"points": BOX, "tip": (0.0, 0.0)},
        "domain.tip (0, 0): must not be the attachment",
    ),
}


@pytest.mark.parametrize(("table", "said"), REFUSED.values(), ids=REFUSED)
def test_a_bad_blade_is_refused_with_key_and_place(table, said):
    with pytest.raises(OutlineError) as caught:
        blade(**table)
    message = str(caught.value)
    assert message.startswith(said)
    assert "\n" not in message


INVALID = {
    "none": ({}, "no outline given; give exactly one of 'shape', 'points', 'file'"),
    "two": ({"shape": "ovate", "file": "a.csv"}, "'shape' and 'file' given"),
    "parameters of points": (
        {"points": BOX, "parameters": {"shape": "ovate"}},
        "'parameters' is for shape, not for points",
    ),
    "parameters of points that name no shape": (
        {"points": BOX, "parameters": {"sinus": 0.3}},
        "'parameters' is for shape, not for points",
    ),
    "no seeds": ({"shape": "ovate", "seeds": []}, "at least 1 item"),
    "smooth shape": ({"shape": "ovate", "smooth": True}, "'smooth' is for points and file"),
    "attachment of shape": ({"shape": "ovate", "attachment": "lowest"}, "'attachment' is for"),
    "other shape": (
        {"shape": "ovate", "parameters": {"shape": "fan"}},
        "parameters.shape = 'fan': must be 'ovate'",
    ),
    "unknown parameter": ({"shape": "ovate", "parameters": {"sinus": 1.0}}, "extra_forbidden"),
    "unknown shape": ({"shape": "round"}, "literal_error"),
    "no length": ({"shape": "ovate", "length": 0.0}, "greater_than"),
    "one seed in a row": ({"shape": "linear", "seeds": {"count": 1}}, "greater_than_equal"),
    "few curve points": ({"shape": "ovate", "curve_points": 3}, "greater_than_equal"),
}


@pytest.mark.parametrize(("table", "said"), INVALID.values(), ids=INVALID)
def test_a_wrong_table_is_refused(table, said):
    with pytest.raises(ValidationError) as caught:
        BladeParameters(**{"length": 10.0, **table})
    found = [f"{detail['type']} {detail['msg']}" for detail in caught.value.errors()]
    assert any(said in line for line in found)


def test_the_page_names_every_shape_parameter_and_default():
    for name, shape in SHAPES.items():
        (row,) = re.findall(rf"^\| `{name}` \|.*$", PAGE, flags=re.MULTILINE)
        defaults = {
            key: field.default for key, field in shape.model_fields.items() if key != "shape"
        }
        if name == "reniform":
            numbers = re.search(r"those of `lobed`: (.*) \|", row)[1].split(", ")
            assert [float(number) for number in numbers] == list(defaults.values())
        else:
            said = {key: float(number) for key, number in re.findall(r"`(\w+)` \(([-\d.]+)\)", row)}
            assert said == defaults


def test_the_example_of_the_page_makes_a_blade():
    (text,) = re.findall(r"^```toml\n(.*?)^```$", PAGE, flags=re.MULTILINE | re.DOTALL)
    assert BladeParameters(**tomllib.loads(text)["domain"]).blade().length == 115.0


def test_parameters_load_no_heavy_library():
    code = (
        "import sys; from vasc.domain import BladeParameters;"
        "BladeParameters.model_json_schema(); BladeParameters(shape='ovate', length=1.0);"
        "heavy = {'scipy', 'numba', 'shapely', 'matplotlib', 'skimage', 'PIL', 'svg'};"
        "print(sorted(heavy & set(sys.modules)))"
    )
    found = subprocess.run([sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True)
    assert found.stdout == "[]\n", found.stderr
