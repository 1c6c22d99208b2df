"""The stem laid flat: angles, the cut, what goes on beyond it, and the picture."""

import re
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from reference.stem_veins import laid_out

from vasc.analysis.ways import ways
from vasc.errors import OutputError, ShapeError
from vasc.render import UnrolledStyle, draw_unrolled
from vasc.render.unrolled import _beyond, draw_flat, unroll

RADIUS = 50.0


@pytest.fixture(scope="module")
def stem():
    """Give a stem of ten primordia whose veins are laid out by hand."""
    return laid_out(137.5, RADIUS, 10.0, [[m + 3, m + 5] for m in range(10)])


def drawn(stem, tmp_path, name="stem.svg", **options):
    """Draw and give the text of the picture."""
    positions, segments, primordia, _ = stem
    path = draw_unrolled(positions, segments, primordia, tmp_path / name, radius=RADIUS, **options)
    return path.read_text()


def test_primordia_are_where_phyllotaxis_puts_them(stem):
    positions, segments, primordia, _ = stem
    places = unroll(positions, segments, RADIUS).places[primordia]
    numbers = np.arange(10)
    # angles of 0 may come out as just below a full turn
    off = (places[:, 0] - numbers * 137.5 + 180.0) % 360.0 - 180.0
    np.testing.assert_allclose(off, 0.0, atol=1e-9)
    np.testing.assert_allclose(places[:, 1], 10.0 * (numbers + 1))


@pytest.mark.parametrize("quadrant", range(4))
def test_every_quadrant_is_kept(quadrant):
    angle = np.radians(30.0 + 90.0 * quadrant)
    point = np.array([[np.cos(angle), np.sin(angle), 0.0]])
    flat = unroll(point, np.zeros((0, 2), int), 1.0)
    assert flat.places[0, 0] == pytest.approx(30.0 + 90.0 * quadrant)


@given(
    angles=st.lists(st.floats(0.0, 359.0), min_size=2, max_size=2),
    cut=st.floats(0.0, 360.0),
)
def test_a_segment_goes_the_short_way_wherever_the_cut_is(angles, cut):
    turns = np.radians(angles)
    positions = np.stack([np.cos(turns), np.sin(turns), turns], axis=1)
    segments = np.array([[0, 1]])
    whole = unroll(positions, segments, 1.0)
    flat = unroll(positions, segments, 1.0, cut=np.radians(cut))
    short = (angles[1] - angles[0] + 180.0) % 360.0 - 180.0
    assert abs(whole.reach[0]) <= 180.0
    if abs(short) < 179.9:
        assert whole.reach[0] == pytest.approx(short, abs=1e-9)
        assert flat.reach[0] == pytest.approx(short, abs=1e-9)
        straight = flat.places[0, 0] + flat.reach[0]
        assert flat.is_severed[0] == (abs(straight - flat.places[1, 0]) > 180.0)


def test_veins_near_the_axis_are_faded():
    positions = np.array([[5.0, 0.0, 0.0], [0.9, 0.0, 1.0], [0.0, -4.0, 2.0]])
    flat = unroll(positions, np.array([[0, 1], [1, 2], [0, 2]]), 5.0)
    assert flat.is_faded.tolist() == [True, True, False]


def test_what_the_cut_goes_through_goes_on_to_the_next_primordia(stem):
    positions, segments, primordia, ring = stem
    flat = unroll(positions, segments, RADIUS)
    beyond = segments[_beyond(flat, segments, primordia, len(positions))]
    assert not np.isin(beyond, ring).all(axis=1).any()
    reached = np.flatnonzero(np.isin(primordia, beyond)).tolist()
    # 3 m and 5 m to the right and left of the cut: links 0-3, 0-5, 2-5, 3-8, 5-8
    assert {0, 3, 5, 8} <= set(reached)
    # 1 to 4 and 1 to 6 are on the far side
    assert 1 not in reached
    assert 4 not in reached


@given(st.lists(st.tuples(st.integers(0, 8), st.integers(0, 8)), max_size=20))
def test_ways_hold_every_segment_once(pairs):
    segments = sorted({(min(a, b), max(a, b)) for a, b in pairs if a != b})
    found_ways = list(ways(np.array(segments, dtype=int).reshape(-1, 2)))
    found = [(min(a, b), max(a, b)) for way in found_ways for a, b in pairwise(way)]
    assert sorted(found) == segments


def test_a_way_without_a_fork_is_one_line():
    assert sorted(map(len, ways(np.array([[0, 1], [2, 1], [2, 3]])))) == [4]
    assert sorted(map(len, ways(np.array([[0, 1], [1, 2], [2, 0]])))) == [4]
    assert sorted(map(len, ways(np.array([[0, 1], [1, 2], [1, 3]])))) == [2, 2, 2]


def test_the_picture_has_numbered_boxes_and_dashes(stem, tmp_path):
    text = drawn(stem, tmp_path, title="(3, 5)")
    style = UnrolledStyle()
    assert len(re.findall(f"fill: {style.box}", text)) == 10
    for color in (style.vein, style.severed):
        assert color in text
    assert "stroke-dasharray" in text
    # no vein of this stem is near the axis
    assert style.faded not in text


@pytest.mark.parametrize(("divergence", "step", "is_hidden"), [(137.5, 5, True), (180.0, 2, False)])
def test_boxes_leave_the_veins_of_rows_free(divergence, step, is_hidden):
    positions, segments, primordia, _ = laid_out(
        divergence, RADIUS, 10.0, [[m + step] for m in range(30)]
    )
    figure = Figure(figsize=(7.0, 4.0))
    FigureCanvasAgg(figure)
    axes = figure.add_axes((0.1, 0.1, 0.8, 0.8))
    draw_flat(axes, positions, segments, primordia, radius=RADIUS)
    figure.draw_without_rendering()
    boxes = {text.get_text(): text.get_bbox_patch().get_window_extent() for text in axes.texts}
    assert len(boxes) == 30
    places = unroll(positions, segments, RADIUS).places[primordia]
    for number, place in enumerate(axes.transData.transform(places)):
        # near the cut a box may be drawn on both sides
        if 60.0 < places[number, 0] < 300.0:
            assert boxes[str(number)].contains(*place) == is_hidden


def test_equal_stems_give_equal_bytes(stem, tmp_path):
    assert drawn(stem, tmp_path) == drawn(stem, tmp_path)
    assert drawn(stem, tmp_path) != drawn(stem, tmp_path, cut=1.0)


@pytest.mark.parametrize("suffix", ["png", "pdf"])
def test_other_kinds_of_pictures(stem, suffix, tmp_path):
    positions, segments, primordia, _ = stem
    path = tmp_path / f"stem.{suffix}"
    assert draw_unrolled(positions, segments, primordia, path, radius=RADIUS) == path
    assert path.stat().st_size > 1000


def test_a_stem_without_veins_is_drawn(tmp_path):
    nothing = np.zeros((0, 3)), np.zeros((0, 2), int), np.zeros(0, int), np.zeros(0, int)
    assert UnrolledStyle().vein not in drawn(nothing, tmp_path)
    points = np.array([[50.0, 0.0, 10.0]]), np.zeros((0, 2), int), np.array([0]), np.zeros(0, int)
    assert len(re.findall(f"fill: {UnrolledStyle().box}", drawn(points, tmp_path))) == 1


def test_wrong_arrays_and_files_are_refused(stem, tmp_path):
    positions, segments, primordia, _ = stem
    with pytest.raises(ShapeError, match="positions"):
        draw_unrolled(positions[:, :2], segments, primordia, tmp_path / "a.png", radius=RADIUS)
    with pytest.raises(OutputError, match="suffix"):
        draw_unrolled(positions, segments, primordia, tmp_path / "a.txt", radius=RADIUS)
