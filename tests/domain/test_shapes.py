"""Named shapes: sound, symmetric, of the right size, and of the form their parameters say."""

import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st
from pydantic import ValidationError

from vasc.domain import SHAPES, Blade
from vasc.domain.palmate import Fan, Lobed, Reniform
from vasc.domain.shapes import Bilobed, Cordate, Dome, Elliptic, Linear, Obovate, Orbicular, Ovate

NAMES = sorted(SHAPES)


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("n_points", [16, 320, 5000])
def test_every_shape_hangs_on_the_origin_and_is_one_high(name, n_points):
    ring = SHAPES[name]().outline(n_points)
    assert ring[0].tolist() == [0.0, 0.0]
    assert ring[:, 1].max() == 1.0
    assert len(ring) < 1.2 * n_points + 40
    blade = Blade.from_rings([ring])
    # counter-clockwise
    assert shapely.LinearRing(ring).is_ccw
    assert blade.length == 1.0


@pytest.mark.parametrize("name", NAMES)
def test_every_shape_is_its_own_mirror_image(name):
    ring = SHAPES[name]().outline(320)
    mirrored = np.concatenate([ring[:1], ring[:0:-1]]) * np.array([-1.0, 1.0])
    assert np.array_equal(mirrored, ring)


@pytest.mark.parametrize("name", NAMES)
def test_every_shape_can_grow_at_its_margin(name):
    assert Blade.from_rings([SHAPES[name]().outline(320)]).is_star_shaped


@pytest.mark.parametrize("name", NAMES)
def test_more_points_draw_the_same_shape(name):
    few, many = (shapely.Polygon(SHAPES[name]().outline(n)) for n in (320, 4000))
    assert few.symmetric_difference(many).area < 2e-3 * many.area


def any_parameters(name):
    """Draw parameters of a shape within their bounds."""
    fields = SHAPES[name].model_json_schema()["properties"]
    drawn = {}
    for key, field in fields.items():
        if field["type"] == "number":
            low = field.get("minimum", field.get("exclusiveMinimum", 0.0) + 1e-3)
            drawn[key] = st.floats(low, field["maximum"])
        elif field["type"] == "integer":
            drawn[key] = st.integers(field["minimum"], field["maximum"])
    return st.fixed_dictionaries(drawn)


@pytest.mark.parametrize("name", NAMES)
def test_most_parameters_give_a_sound_outline(name):
    # within the bounds of parameters only odd mixtures cross themselves
    outcomes = []

    @given(any_parameters(name))
    def draw(parameters):
        ring = SHAPES[name](**parameters).outline(200)
        assert np.isfinite(ring).all()
        outcomes.append(shapely.LinearRing(ring).is_simple)

    draw()
    assert np.mean(outcomes) > 0.8


@given(st.integers(2, 15), st.floats(60.0, 320.0), st.floats(0.05, 0.8), st.floats(0.3, 1.0))
def test_lobed_blades_are_sound_over_the_useful_range(lobes, spread, depth, outer):
    ring = Lobed(lobes=lobes, spread=spread, depth=depth, outer=outer).outline(400)
    assert shapely.LinearRing(ring).is_simple


def peaks(ring):
    """Count the places that are farther from the attachment than those around."""
    distance = (ring * ring).sum(axis=1)
    return int(((distance > np.roll(distance, 1)) & (distance > np.roll(distance, -1))).sum())


@pytest.mark.parametrize("lobes", [3, 4, 5, 7, 8])
def test_a_lobed_blade_has_its_lobes(lobes):
    assert peaks(Lobed(lobes=lobes).outline(600)) == lobes


def test_a_reniform_blade_has_a_basal_sinus_and_shallow_lobes():
    ring = Reniform().outline(600)
    assert peaks(ring) == 9
    assert ring[:, 1].min() < -0.3
    shape = shapely.Polygon(ring)
    assert shape.area / shape.convex_hull.area > 0.8


def test_ellipse_and_circle_have_their_area():
    ring = Elliptic().outline(4000)
    assert shapely.Polygon(ring).area == pytest.approx(np.pi * 0.5 * 0.3, rel=1e-4)
    ring = Orbicular().outline(4000)
    radii = np.sqrt(((ring - [0.0, 0.5]) ** 2).sum(axis=1))
    np.testing.assert_allclose(radii, 0.5, atol=1e-5)


@pytest.mark.parametrize(("shape", "low", "high"), [(Ovate, 0.2, 0.45), (Obovate, 0.55, 0.8)])
def test_eggs_are_widest_where_they_say(shape, low, high):
    parameters = shape()
    ring = parameters.outline(2000)
    widest = ring[np.argmax(ring[:, 0]), 1]
    assert low < widest < high
    assert widest == pytest.approx(parameters.widest, abs=0.02)


def test_a_heart_reaches_below_the_attachment_by_its_sinus():
    assert Cordate(sinus=0.2).outline(2000)[:, 1].min() == pytest.approx(-0.2, abs=1e-3)


def test_tips_are_drawn_out_pointed_or_round():
    widths = []
    for tip in (-1.0, 0.0, 1.0):
        shape = shapely.Polygon(Ovate(tip=tip).outline(2000))
        widths.append(shape.intersection(shapely.box(-1, 0.9, 1, 1)).area)
    assert widths[0] < 0.5 * widths[1]
    assert widths[1] < 0.7 * widths[2]


def test_a_strap_has_parallel_margins_and_a_straight_base():
    ring = Linear().outline(400)
    shape = shapely.Polygon(ring)
    at = [shape.intersection(shapely.LineString([(-1, y), (1, y)])).length for y in (0.3, 0.5)]
    assert at[0] == pytest.approx(at[1])
    base = ring[ring[:, 1] == 0.0]
    assert np.ptp(base[:, 0]) == pytest.approx(0.8 * 0.12)
    cut = Linear(taper=0.0, base_width=1.0).outline(400)
    assert shapely.Polygon(cut).equals(shapely.box(-0.06, 0.0, 0.06, 1.0))


def test_a_fan_has_straight_sides_and_a_notch_where_wanted():
    ring = Fan(notch=0.5, waves=0).outline(800)
    assert ring[np.argmin(np.abs(ring[1:, 0])) + 1, 1] < 0.6
    # the second point is the shoulder, straight from the attachment at half the opening
    shoulder = ring[1]
    assert shoulder[0] / shoulder[1] == pytest.approx(np.tan(np.radians(62.5)), rel=1e-9)


def test_a_dome_stands_on_a_straight_base_with_straight_sides():
    shape = shapely.Polygon(Dome(dome=0.4).outline(2000))
    side = shapely.box(-0.25, 0.0, 0.25, 0.6)
    assert shape.covers(side)
    rest = shape.difference(side)
    assert rest.area == pytest.approx(0.5 * np.pi * 0.25 * 0.4, rel=1e-4)
    assert shapely.Polygon(Dome(dome=1.0).outline(400)).is_valid


def test_the_length_of_a_bilobed_blade_is_the_height_of_its_lobes():
    ring = Bilobed(notch=0.3).outline(800)
    on_axis = ring[(ring[:, 0] == 0.0) & (ring[:, 1] > 0.0)]
    assert on_axis.tolist() == [[0.0, pytest.approx(0.7)]]
    assert ring[:, 1].max() == 1.0


@pytest.mark.parametrize(
    ("name", "parameters"),
    [
        ("ovate", {"tip": 1.5}),
        ("ovate", {"sinus": 0.1}),
        ("lobed", {"lobes": 1}),
        ("lobed", {"lobes": 2.5}),
        ("fan", {"opening": 0.0}),
        ("cordate", {"sinus": float("nan")}),
    ],
)
def test_parameters_are_bounded_and_named(name, parameters):
    with pytest.raises(ValidationError):
        SHAPES[name](**parameters)
