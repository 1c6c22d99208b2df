"""Stems in three dimensions: what is near hides what is far, and where all of it is."""

from dataclasses import dataclass

import matplotlib.image
import numpy as np
import pytest
from matplotlib.colors import to_rgb
from reference.stem_run import STEM, recorded_in

from vasc.config.changes import heading
from vasc.errors import TimelineError, VascError
from vasc.render import StemStyle, animate, draw_stem, render
from vasc.render.stems import LINE, title_of
from vasc.render.tubes import OVERSAMPLING, Spheres, paint, swept
from vasc.timeline import Timeline
from vasc.timeline.stems import recorded_stem

RED, BLUE = (1.0, 0.0, 0.0), (0.0, 0.0, 1.0)


@pytest.fixture(scope="module")
def run_file(tmp_path_factory):
    """Give the timeline of a small stem."""
    return recorded_in(tmp_path_factory.mktemp("stem"))


def seen(*rows, nearness=1.0):
    """Paint spheres given as (x, y, z, radius, color) on 20 by 10 lengths."""
    places = np.array([row[:3] for row in rows], dtype=float).reshape(-1, 3)
    radii = np.array([row[3] for row in rows], dtype=float)
    colors = np.array([row[4] for row in rows], dtype=float).reshape(-1, 3)
    spheres = Spheres(places, radii, colors, np.full(len(rows), nearness))
    return paint(spheres, (-10.0, 0.0, 10.0, 10.0), 4.0)


def test_the_nearer_sphere_is_seen_whatever_the_order():
    near, far = (0.0, 5.0, 3.0, 2.0, RED), (0.0, 5.0, -3.0, 3.0, BLUE)
    first, second = seen(near, far), seen(far, near)
    np.testing.assert_array_equal(first, second)
    red, _, blue, opacity = first[20, 40]
    assert red > blue
    assert opacity == 255
    # the larger one behind shows around it
    red, _, blue, opacity = first[20, 40 + 10]
    assert blue > red
    assert opacity == 255


def test_a_sphere_covers_its_disc_and_no_more():
    picture = seen((-6.0, 7.0, 0.0, 2.5, RED))
    assert picture.shape == (40, 80, 4)
    rows, columns = np.indices(picture.shape[:2])
    x, y = -10.0 + (columns + 0.5) / 4.0, 10.0 - (rows + 0.5) / 4.0
    distances = np.hypot(x + 6.0, y - 7.0)
    slack = 0.5 / 4.0 * np.sqrt(2.0)
    assert (picture[distances < 2.5 - slack, 3] == 255).all()
    assert (picture[distances > 2.5 + slack, 3] == 0).all()
    area = picture[..., 3].sum() / 255.0 / 16.0
    assert area == pytest.approx(np.pi * 2.5**2, rel=0.5 / (2.5 * 4.0 * OVERSAMPLING))


def test_light_comes_from_the_upper_left_and_far_things_are_pale():
    picture = seen((0.0, 5.0, 0.0, 4.0, RED)).astype(int)
    assert picture[12, 32, 0] > picture[28, 48, 0]
    far = seen((0.0, 5.0, 0.0, 4.0, RED), nearness=0.0).astype(int)
    assert (far[20, 40, :3] >= picture[20, 40, :3]).all()
    assert far[20, 40, 1] > 150


def test_nothing_to_paint_is_clear():
    assert not seen().any()


def test_tubes_are_whole_and_change_their_width_evenly():
    points = np.array([[0.0, 0.0, 0.0], [10.0, 0.0, 0.0], [10.0, 0.1, 0.0]])
    centres, radii = swept(points, np.array([2.0, 1.0, 1.0]), np.array([[0, 1], [1, 2]]), 0.5)
    along = centres[radii > 1.0]
    assert np.diff(along[:, 0]).max() <= 0.5 + 1e-12
    np.testing.assert_allclose(radii[: len(along)], 2.0 - 0.1 * along[:, 0])
    assert len(centres) == len(along) + 1


def test_primordia_are_where_they_are_seen(run_file, tmp_path):
    """From the side the last primordium is at its height and angle, in its colour."""
    style = StemStyle(azimuth=float(7 * 137.5), elevation=0.0, padding=0.0)
    with Timeline(run_file) as timeline:
        stem = recorded_stem(timeline)
    figure = draw_stem(stem.positions, stem.segments, stem.primordia, radii=stem.radii, style=style)
    (axes,) = figure.axes
    (image,) = axes.images
    pixels = image.get_array()
    left, right, bottom, top = image.get_extent()
    row = int((top - 80.0) / (top - bottom) * pixels.shape[0])
    column = int((0.0 - left) / (right - left) * pixels.shape[1])
    red, green, blue, opacity = pixels[row, column]
    assert opacity == 255
    shares = np.array([red, green, blue]) / red
    assert shares == pytest.approx(np.array(to_rgb(style.primordium)) / 0.878, abs=0.25)
    assert axes.get_xlim()[0] <= left < right <= axes.get_xlim()[1]


@pytest.mark.parametrize("suffix", ["png", "svg", "pdf"])
@pytest.mark.parametrize("unroll", [False, True])
def test_equal_runs_give_equal_pictures(run_file, suffix, unroll, tmp_path):
    files = [tmp_path / f"{name}.{suffix}" for name in "ab"]
    for file in files:
        assert render(run_file, file, unroll=unroll, pixels=400) == file
    assert files[0].read_bytes() == files[1].read_bytes()


def test_a_picture_has_the_size_asked_for(run_file, tmp_path):
    file = render(run_file, tmp_path / "a.png", pixels=500)
    assert max(matplotlib.image.imread(file).shape[:2]) == 500


def test_an_earlier_step_has_fewer_primordia(run_file, tmp_path):
    with Timeline(run_file) as timeline:
        young, old = recorded_stem(timeline, 10), recorded_stem(timeline)
    assert 0 < len(young.primordia) < len(old.primordia) == 8
    late = render(run_file, tmp_path / "late.png", pixels=400).read_bytes()
    assert render(run_file, tmp_path / "early.png", 10, pixels=400).read_bytes() != late


def test_the_bare_ring_is_drawn(run_file, tmp_path):
    for unroll in (False, True):
        render(run_file, tmp_path / "ring.png", 0, unroll=unroll, pixels=400)
        pixels = matplotlib.image.imread(tmp_path / "ring.png")[:, :, :3]
        assert (pixels.min(axis=2) < 0.8).any()


def test_a_stem_with_a_tapering_apex_is_drawn(tmp_path):
    text = STEM.replace("radius = 12.0", "radii = [[0.0, 20.0], [80.0, 6.0]]")
    path = recorded_in(tmp_path, text)
    with Timeline(path) as timeline:
        stem = recorded_stem(timeline)
    heights = stem.positions[:, 2]
    np.testing.assert_allclose(stem.radii, np.interp(heights, [0.0, 80.0], [20.0, 6.0]))
    for unroll in (False, True):
        render(path, tmp_path / "a.png", unroll=unroll, pixels=300)


def test_what_is_for_leaves_alone_is_refused(run_file, tmp_path):
    output = tmp_path / "a.png"
    for options, key in (
        ({"steps": [1, 2]}, "steps"),
        ({"color": "age"}, "color"),
        ({"sources": True}, "sources"),
    ):
        with pytest.raises(VascError, match=key):
            render(run_file, output, **options)
    with pytest.raises(VascError, match="films are made of leaves"):
        animate(run_file, tmp_path / "a.gif")
    assert not list(tmp_path.iterdir())


def test_a_leaf_is_no_stem(recorded_leaf, tmp_path):
    with Timeline(recorded_leaf) as timeline, pytest.raises(TimelineError, match="is no stem"):
        recorded_stem(timeline)
    with pytest.raises(VascError, match="only a stem can be unrolled"):
        render(recorded_leaf, tmp_path / "a.png", unroll=True)


@pytest.fixture
def recorded_leaf(tmp_path):
    """Give the timeline of a leaf that has hardly begun."""
    text = """kind = "open"
[domain]
shape = "ovate"
length = 20.0
[growth]
kind = "none"
[placement]
kind = "given"
points = [[0.0, 5.0]]
[arrival]
kill_distance = 1.0
"""
    (tmp_path / "leaf").mkdir()
    return recorded_in(tmp_path / "leaf", text, "leaf")


@dataclass
class Titled:
    """What a title is told from."""

    config: dict[str, str]
    config_toml: str


def test_values_set_outside_of_the_config_stand_below_its_title():
    config = {"title": "A stem"}
    assert title_of(Titled(config, "")) == "A stem"
    assert title_of(Titled(config, heading(["seed = 3"]))) == "A stem"
    changed = heading(["placement.rise = 2.0", "seed = 3"])
    assert title_of(Titled(config, changed)) == "A stem\nwith placement.rise = 2.0"
    many = heading(f"placement.key_{k} = {k}" for k in range(20))
    title, line = title_of(Titled(config, many)).split("\n")
    assert title == "A stem"
    assert line.endswith(" ...")
    assert len(line) <= LINE
