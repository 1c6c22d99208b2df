"""Local-to-global growth: a twin by quadrature, forth and back, mirrored, and what is refused."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from pydantic import ValidationError
from scipy.integrate import quad
from scipy.interpolate import PchipInterpolator

from vasc.config import load_text
from vasc.domain import Blade, BladeParameters
from vasc.errors import ConfigError
from vasc.growth import LocalToGlobalParameters
from vasc.growth.base import MARGIN_SPACING
from vasc.growth.margins import from_base, is_mirrored
from vasc.growth.stretch import roots

HEIGHTS = [0.0, 0.15, 0.3, 0.45, 0.6, 0.75, 0.9, 1.0]
G_X = [0.25, 0.3, 0.75, 1.0, 1.05, 1.05, 1.0, 0.9]
G_Y = [0.8, 0.85, 0.85, 0.85, 0.8, 0.75, 0.6, 0.5]
TABLE = {"heights": HEIGHTS, "g_x": G_X, "g_y": G_Y}
DOME = BladeParameters(shape="dome", length=8.0, width=0.5).blade()
STEPS = (0, 1, 7, 100, 333, 600)


def growth_of(blade=DOME, **changes):
    """Give the growth of a blade by the table above."""
    return LocalToGlobalParameters(**TABLE | {"end": 6.0} | changes).growth(blade)


@pytest.fixture(scope="module")
def growth():
    return growth_of()


def places_in(blade, n_points=200):
    """Give points spread over a blade."""
    left, low, right, high = blade.bounds
    points = np.random.default_rng(1).random((n_points, 2))
    return points * [right - left, high - low] + [left, low]


def twin(points, time):
    """Give positions by the formulas of the thesis in their power form."""
    across, along = (PchipInterpolator(HEIGHTS, values) for values in (G_X, G_Y))
    heights = [
        quad(lambda h: (1.0 + along(h / 8.0)) ** time, 0.0, y, epsabs=1e-10, limit=200)[0]
        for y in points[:, 1]
    ]
    return np.stack([points[:, 0] * (1.0 + across(points[:, 1] / 8.0)) ** time, heights], axis=1)


@pytest.mark.parametrize("step", STEPS)
def test_positions_are_those_of_a_quadrature(growth, step):
    points = places_in(DOME, 40)
    # between samples 0.004 D apart the error is an eighth of the square, times the curvature
    np.testing.assert_allclose(growth.position(points, step), twin(points, step / 100.0), rtol=1e-5)


def test_equal_rates_give_plain_exponential_growth():
    growth = growth_of(g_x=[0.5] * 8, g_y=[1.0] * 8)
    points = places_in(DOME)
    expected = points * [1.5**2, 2.0**2]
    np.testing.assert_allclose(growth.position(points, 200), expected, rtol=1e-12)


@pytest.mark.parametrize("step", STEPS)
def test_there_and_back(growth, step):
    points = places_in(DOME)
    there = growth.position(points, step)
    np.testing.assert_allclose(growth.material(there, step), points, rtol=0.0, atol=1e-9)
    material, position = growth.embed(there, step)
    np.testing.assert_allclose(material, points, rtol=0.0, atol=1e-9)
    np.testing.assert_allclose(position, there, rtol=1e-9)


def test_places_beyond_tip_and_base_are_taken_to_the_nearest_height(growth):
    top = growth.domain(600).length
    _, position = growth.embed(np.array([[3.0, top + 50.0], [-2.0, -9.0]]), 600)
    np.testing.assert_allclose(position, [[3.0, top], [-2.0, 0.0]], rtol=1e-12)


@pytest.mark.parametrize("step", STEPS)
def test_left_and_right_are_mirror_images_in_every_bit(growth, step):
    points = places_in(DOME)
    mirror = np.array([-1.0, 1.0])
    there = growth.position(points, step)
    assert np.array_equal(growth.position(points * mirror, step), there * mirror)
    assert np.array_equal(
        growth.material(there * mirror, step), growth.material(there, step) * mirror
    )


def test_heights_keep_their_order_and_the_blade_does_not_cross_itself(growth):
    for step in range(0, 601, 50):
        assert (np.diff(growth.stretch.at(step)[1]) > 0.0).all()
        assert growth.domain(step).polygon.is_valid


def test_steps_give_the_same_bytes_in_any_order(growth):
    other = growth_of()
    points = places_in(DOME)
    late = growth.position(points, 600)
    early = growth.position(points, 10)
    assert np.array_equal(other.position(points, 10), early)
    assert np.array_equal(other.position(points, 600), late)


def test_growth_ends(growth):
    assert growth.last_step == 600
    assert growth.time(250) == 2.5
    points = places_in(DOME)
    assert np.array_equal(growth.position(points, 601), growth.position(points, 600))
    assert growth.domain(900) == growth.domain(600)
    assert growth_of(end=0.3, steps_per_unit=10).last_step == 3


def test_the_first_blade_is_the_one_given(growth):
    assert growth.blade.length == pytest.approx(8.0, rel=1e-14)
    assert growth.blade.area == pytest.approx(DOME.area, rel=1e-12)
    assert growth.seeds.tolist() == [[0.0, 0.0]]


def test_roots_are_the_nearest_floats():
    factors = np.random.default_rng(2).uniform(0.01, 5.0, 200)
    np.testing.assert_array_equal(roots(factors, 1), factors)
    np.testing.assert_allclose(roots(factors, 100), factors**0.01, rtol=3e-16)


# outlines


@pytest.mark.parametrize("shape", ["dome", "elliptic", "linear", "cordate"])
@pytest.mark.parametrize("curve_points", [16, 320, 321])
def test_neighbours_on_the_margin_stay_near_each_other(shape, curve_points):
    blade = BladeParameters(shape=shape, length=8.0, curve_points=curve_points).blade()
    growth = growth_of(blade, end=4.0)
    for step in range(401):
        ring = growth.position(growth.margin, step)
        offsets = np.roll(ring, -1, axis=0) - ring
        assert np.sqrt((offsets * offsets).sum(axis=1)).max() <= MARGIN_SPACING
    assert is_mirrored(from_base(growth.margin))
    # not more points than needed
    assert len(growth.margin) < len(blade.rings[0]) + 1.5 * np.sqrt(offsets**2).sum() + 50


def test_the_base_comes_first_and_is_no_margin():
    growth = growth_of()
    base, rest = growth.margin[: growth.n_base], growth.margin[growth.n_base :]
    assert (base[:, 1] == 0.0).all()
    assert (rest[:, 1] > 0.0).all()
    assert base[0].tolist() == [-2.0, 0.0]
    assert base[-1].tolist() == [2.0, 0.0]
    assert base[len(base) // 2].tolist() == [0.0, 0.0]
    pointed = growth_of(BladeParameters(shape="elliptic", length=8.0).blade())
    assert pointed.n_base == 1
    assert pointed.margin[0].tolist() == [0.0, 0.0]


def test_a_lopsided_outline_is_carried_along():
    ring = np.array([[-1.0, 0.0], [2.0, 0.0], [3.0, 4.0], [0.0, 8.0], [-1.5, 5.0]])
    growth = growth_of(Blade.from_rings([ring[::-1]]), end=2.0)
    base = growth.margin[: growth.n_base]
    assert base[0].tolist() == [-1.0, 0.0]
    assert base[-1].tolist() == [2.0, 0.0]
    assert growth.margin[growth.n_base, 1] > 0.0
    ring = growth.position(growth.margin, 200)
    offsets = np.roll(ring, -1, axis=0) - ring
    assert np.sqrt((offsets * offsets).sum(axis=1)).max() <= MARGIN_SPACING


def test_an_outline_without_points_on_the_axis_is_mirrored_too():
    right = np.array([[1.0, 0.0], [2.0, 4.0], [1.0, 8.0]])
    ring = np.concatenate([right, right[::-1] * [-1.0, 1.0]])
    growth = growth_of(Blade.from_rings([ring]), end=2.0)
    assert is_mirrored(from_base(growth.margin))
    assert growth.margin[growth.n_base // 2].tolist() == [0.0, 0.0]


def test_lobes_below_the_attachment_grow_as_it_does():
    blade = BladeParameters(shape="cordate", length=8.0).blade()
    growth = growth_of(blade)
    points = np.array([[1.0, -0.5], [1.0, 0.0]])
    there = growth.position(points, 300)
    assert there[0].tolist() == pytest.approx([1.25**3, -0.5 * 1.8**3], rel=1e-9)
    np.testing.assert_allclose(growth.material(there, 300), points, atol=1e-9)


def test_the_box_holds_the_blade_and_straight_veins_at_all_steps():
    waist = {"heights": [0.0, 0.5, 1.0], "g_x": [1.0, 0.05, 1.0], "g_y": [0.5, 0.5, 0.5]}
    growth = growth_of(**waist)
    left, low, right, high = growth.box
    for step in range(0, 601, 25):
        ring = growth.domain(step).rings[0]
        assert left <= ring[:, 0].min() < ring[:, 0].max() <= right
        assert low <= ring[:, 1].min() < ring[:, 1].max() <= high
        # a vein straight across the waist, from lobe to lobe, as it is carried along
        widest = float(ring[:, 0].max())
        heights = np.linspace(0.0, growth.domain(step).length, 50)
        places = np.stack([np.full(50, widest), heights], axis=1)
        later = growth.position(growth.material(places, step), 600)
        assert later[:, 0].max() <= right * (1.0 + 1e-2)


@settings(max_examples=25)
@given(
    st.lists(st.floats(-0.3, 1.2), min_size=4, max_size=4),
    st.lists(st.floats(-0.3, 1.2), min_size=4, max_size=4),
    st.integers(0, 250),
)
def test_any_table_is_undone(g_x, g_y, step):
    growth = growth_of(heights=[0.0, 0.2, 0.7, 1.0], g_x=g_x, g_y=g_y, end=2.5)
    points = places_in(DOME)
    there = growth.position(points, step)
    np.testing.assert_allclose(growth.material(there, step), points, rtol=0.0, atol=1e-9)
    assert growth.domain(step).polygon.is_valid


# tables and errors


def test_a_table_may_be_a_file(tmp_path, growth):
    rows = "\n".join(f"{h}, {x}, {y}" for h, x, y in zip(HEIGHTS, G_X, G_Y, strict=True))
    (tmp_path / "table.csv").write_text("height, g_x, g_y\n" + rows)
    parameters = LocalToGlobalParameters(file="table.csv", end=6.0)
    points = places_in(DOME)
    read = parameters.growth(DOME, tmp_path)
    assert np.array_equal(read.position(points, 321), growth.position(points, 321))


def test_a_config_may_name_the_file(tmp_path):
    (tmp_path / "table.csv").write_text("height,g_x,g_y\n0,0.5,0.5\n1,0.5,1.0\n")
    text = """kind = "closed"
    domain = { shape = "dome", length = 8.0 }
    growth = { kind = "local_to_global", file = "table.csv", end = 1.0 }
    placement = { kind = "given", points = [[0.0, 5.0]] }
    arrival = { kill_distance = 1.0 }"""
    experiment = load_text(text, folder=tmp_path)
    assert list(experiment.files) == ["table.csv"]
    assert experiment.parameters.parts(experiment.folder)["growth"].last_step == 100


@pytest.mark.parametrize(
    ("content", "problem"),
    [
        ("height,g_x\n0,1\n1,1\n", "line 2 of .*columns height, g_x and g_y, all numbers"),
        ("height,g_x,g_y\n0,1,1\n1,fast,1\n", "line 3"),
        ("height,g_x,g_y\n0,1,1\n", "'heights' holds 1 values; at least 2"),
        ("height,g_x,g_y\n0,1,1\n1,nan,1\n", r"g_x\[1\] is nan; it must be above -1"),
        (None, "cannot read"),
    ],
)
def test_files_that_hold_no_table_are_refused(tmp_path, content, problem):
    if content is not None:
        (tmp_path / "table.csv").write_text(content)
    with pytest.raises(ConfigError, match=rf"growth\.file: .*{problem}"):
        LocalToGlobalParameters(file="table.csv", end=1.0).growth(DOME, tmp_path)


@pytest.mark.parametrize(
    ("changes", "problem"),
    [
        ({"g_x": [0.1, 0.2]}, "'g_x' holds 2 values; it must have one for each of the 8 heights"),
        ({"heights": sorted(HEIGHTS, reverse=True)}, r"heights\[1\] is 0.9; heights must ascend"),
        ({"heights": [*HEIGHTS[:-1], 1.2]}, r"heights\[7\] is 1.2; it must be from 0 to 1"),
        ({"g_y": [*G_Y[:-1], -1.0]}, r"g_y\[7\] is -1; it must be above -1"),
        ({"g_y": [*G_Y[:-1], 1e4]}, r"g_y\[7\] is 10000; it must be .* at most 1000"),
        ({"g_y": None}, "'g_y' is missing"),
        ({"file": "table.csv"}, "give either 'file' or"),
        ({"heights": [0.5], "g_x": [1.0], "g_y": [1.0]}, "at least 2 items"),
        ({"end": 0.0}, "greater than 0"),
        ({"steps_per_unit": 0}, "greater than or equal to 1"),
    ],
)
def test_unsound_tables_are_refused(changes, problem):
    with pytest.raises(ValidationError, match=problem):
        growth_of(**changes)


def test_growth_without_end_is_refused():
    with pytest.raises(ConfigError, match=r"growth\.end = 1e\+06: .*allowed are 1,000,000"):
        growth_of(end=1e6)


@pytest.mark.parametrize("changes", [{"end": 30.0}, {"end": 1e6, "steps_per_unit": 1}])
def test_growth_beyond_all_measure_is_refused(changes):
    with pytest.raises(ConfigError, match=r"outline would need .* points"):
        growth_of(g_x=[1000.0] * 8, g_y=[1000.0] * 8, **changes)


def test_blades_that_cannot_be_carried_along_are_refused():
    square = np.array([[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]])
    with pytest.raises(ConfigError, match="does not pass through the attachment"):
        growth_of(Blade.from_rings([square]))
    blade = Blade.from_rings([square, square * 0.2 + [0.5, 0.5]])
    with pytest.raises(ConfigError, match="2 rings"):
        growth_of(blade)
