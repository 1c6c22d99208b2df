"""Toothed margins: triangular waves along the outward normal."""

import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st
from pydantic import ValidationError

from vasc.domain import SHAPES, BladeParameters, TeethParameters
from vasc.errors import OutlineError


def teeth(amplitudes, frequencies, **parameters):
    return TeethParameters(amplitudes=amplitudes, frequencies=frequencies, **parameters)


def test_a_wave_is_triangular_and_waves_are_summed():
    at = np.linspace(0.0, 1.0, 1001)
    single = teeth([0.1], [4], slant=0.0).wave(at)
    np.testing.assert_allclose(single, 0.1 * (1.0 - np.abs(2.0 * (4 * at % 1.0) - 1.0)), atol=1e-12)
    both = teeth([0.1, 0.02], [4, 12], slant=0.0).wave(at)
    np.testing.assert_allclose(both, single + teeth([0.02], [12], slant=0.0).wave(at))


def test_slanted_teeth_are_highest_nearer_to_the_tip():
    at = np.linspace(0.0, 1.0, 10001)
    assert at[np.argmax(teeth([0.1], [1], slant=0.6).wave(at))] == pytest.approx(0.8)


def test_teeth_stand_on_a_straight_margin_as_asked():
    box = np.array([[0.0, 0.0], [0.3, 0.0], [0.3, 1.0], [0.0, 1.0], [-0.3, 1.0], [-0.3, 0.0]])
    toothed = teeth([0.02], [13], slant=0.0, bare=0.0).applied(box)
    # the teeth of the upper edge have made it higher
    margin = toothed[(toothed[:, 0] > 0.0) & (toothed[:, 1] > 0.1) & (toothed[:, 1] < 0.85)]
    scale = margin[:, 0].min() / 0.3
    assert 0.98 < scale < 1.0
    tops = margin[margin[:, 0] > 0.3199 * scale] / scale
    assert len(tops) == 6
    np.testing.assert_allclose(tops[:, 0], 0.32, atol=1e-12)
    # one side is 1.6 long, of which 1 is straight up
    np.testing.assert_allclose(np.diff(tops[:, 1]), 1.6 / 13)


@pytest.mark.parametrize("name", sorted(SHAPES))
def test_every_shape_can_have_teeth(name):
    ring = SHAPES[name]().outline(320)
    toothed = teeth([0.03, 0.008], [12, 48]).applied(ring)
    assert shapely.LinearRing(toothed).is_simple
    assert toothed[0].tolist() == [0.0, 0.0]
    assert toothed[:, 1].max() == 1.0
    plain, with_teeth = shapely.Polygon(ring), shapely.Polygon(toothed)
    assert with_teeth.area > plain.area
    assert with_teeth.exterior.length > plain.exterior.length


@pytest.mark.parametrize("name", ["ovate", "cordate", "lobed", "reniform", "bilobed"])
def test_teeth_of_a_symmetric_blade_are_symmetric(name):
    toothed = teeth([0.02], [15]).applied(SHAPES[name]().outline(320))
    mirrored = np.concatenate([toothed[:1], toothed[:0:-1]]) * np.array([-1.0, 1.0])
    np.testing.assert_allclose(mirrored, toothed, atol=1e-9)


@given(
    st.sampled_from(sorted(SHAPES)),
    st.floats(0.0, 0.03),
    st.integers(1, 60),
    st.floats(0.0, 0.7),
)
def test_low_teeth_never_cross(name, amplitude, frequency, slant):
    toothed = teeth([amplitude + 1e-6], [frequency], slant=slant).applied(
        SHAPES[name]().outline(200)
    )
    assert shapely.LinearRing(toothed).is_simple


def test_direction_and_first_point_of_a_ring_do_not_matter():
    ring = SHAPES["cordate"]().outline(200)
    expected = teeth([0.02], [9]).applied(ring)
    found = teeth([0.02], [9]).applied(np.roll(ring[::-1], 70, axis=0))
    np.testing.assert_allclose(found, expected, atol=1e-12)


def test_teeth_that_cross_are_refused_with_the_place():
    wide = {"amplitudes": [1.0], "frequencies": [20]}
    with pytest.raises(OutlineError, match=r'^domain.shape = "deltoid": crosses or touches itself'):
        BladeParameters(shape="deltoid", length=1.0, teeth=wide).blade()


def test_a_blade_with_teeth_keeps_its_length():
    parameters = BladeParameters(
        shape="ovate", length=50.0, teeth={"amplitudes": [0.03], "frequencies": [9]}
    )
    assert parameters.blade().length == 50.0


@pytest.mark.parametrize(
    "table",
    [
        {"amplitudes": [0.1], "frequencies": [3, 4]},
        {"amplitudes": [], "frequencies": []},
        {"amplitudes": [0.1], "frequencies": [0]},
        {"amplitudes": [0.1], "frequencies": [50_000]},
        {"amplitudes": [0.1], "frequencies": [3], "slant": 1.0},
    ],
)
def test_senseless_teeth_are_refused(table):
    with pytest.raises(ValidationError):
        TeethParameters(**table)


def test_too_many_points_with_teeth_are_refused():
    angles = np.arange(19_000) * (2.0 * np.pi / 19_000)
    ring = 0.5 * np.stack([np.sin(angles), 1.0 - np.cos(angles)], axis=1)
    with pytest.raises(OutlineError, match="at most 20,000 are allowed with teeth"):
        teeth([0.001], [4000]).applied(ring)
