"""Line widths and colours."""

import numpy as np
import pytest
from reference.halving import halved
from reference.networks import network

from vasc.analysis import WidthParameters
from vasc.analysis.ancestry import descent
from vasc.analysis.widths import radii, segment_radii
from vasc.errors import VascError
from vasc.render.looks import Paint, Scale, color_segments, fit_widths, gradient, width_classes
from vasc.render.styles import COLOR_CHOICES, LeafStyle

STYLE = LeafStyle(finest=(0.5, 2.0), finest_share=0.1, thickest_share=0.02)
# midvein 0-1-2, side vein 1-3, joined 2-3
NET = network(
    np.array([[0, 0], [0, 1], [0, 2], [1, 2.0]]),
    [(0, 1), (1, 2), (1, 3), (2, 3)],
    kinds=[0, 0, 0, 1],
    births=[0, 1, 4, 9],
)


def colors(net, color):
    directions = descent(net)
    paint = Paint(color, LeafStyle(), last_step=9)
    coloring = color_segments(net, paint, directions, 2.0 * segment_radii(net))
    return [coloring.palette[k] for k in coloring.classes], coloring.key


class TestFittedWidths:
    def test_open_radii_follow_the_picture(self):
        # veins 10 D apart at 1 pt per D: the finest is 1 pt wide
        fitted = fit_widths(9.0, WidthParameters(), STYLE, Scale(1.0, 500.0, 10.0))
        assert 2 * fitted.tip_radius == pytest.approx(1.0)
        assert fitted.exponent == pytest.approx(2.0), "9 veinlets make 3 pt, below the limit"

    @pytest.mark.parametrize(("spacing", "width"), [(0.1, 0.5), (1e9, 2.0), (np.inf, 2.0)])
    def test_the_finest_line_stays_visible_and_fine(self, spacing, width):
        fitted = fit_widths(9.0, WidthParameters(), STYLE, Scale(1.0, 500.0, spacing))
        assert 2 * fitted.tip_radius == pytest.approx(width)

    def test_the_thickest_line_is_held_by_a_larger_exponent(self):
        fitted = fit_widths(1e6, WidthParameters(), STYLE, Scale(1.0, 500.0, 10.0))
        widths = 2 * radii(np.array([1.0, 1e3, 1e6]), fitted, 1e6)
        assert widths == pytest.approx([1.0, np.sqrt(10.0), 10.0])

    def test_a_given_tip_radius_draws_to_scale(self):
        given = WidthParameters(tip_radius=0.3, exponent=3.0)
        assert fit_widths(1e6, given, STYLE, Scale(2.0, 500.0, 10.0)) == given

    def test_a_given_base_radius_is_kept(self):
        given = WidthParameters(base_radius=7.0)
        fitted = fit_widths(1e4, given, STYLE, Scale(2.0, 500.0, 10.0))
        assert radii(np.array([1e4]), fitted, 1e4) == pytest.approx([7.0])


class TestWidthClasses:
    def test_neighbouring_classes_differ_by_one_ratio(self):
        widths = np.random.default_rng(0).uniform(0.5, 8.0, 1000)
        classes, class_widths = width_classes(widths, 48)
        step = class_widths[1] / class_widths[0]
        assert np.abs(np.log(widths / class_widths[classes])).max() <= np.log(step) / 2 + 1e-12

    def test_one_width(self):
        classes, class_widths = width_classes(np.array([2.0, 2.0]), 48)
        assert (classes.tolist(), class_widths.tolist()) == ([0, 0], [2.0])

    def test_none(self):
        assert width_classes(np.zeros(0), 48)[0].shape == (0,)


class TestColors:
    @pytest.mark.parametrize("color", COLOR_CHOICES)
    def test_every_choice_colours_every_segment(self, color):
        assert len(colors(NET, color)[0]) == 4

    def test_unknown_choice_is_refused_and_the_others_named(self):
        with pytest.raises(VascError, match=r"'colour' is not one of width, order, age"):
            colors(NET, "colour")

    def test_joins_have_their_own_colour(self):
        found, key = colors(NET, "kind")
        assert found[0] == found[1] == found[2] != found[3]
        assert key.labels == ("extension", "join")

    def test_age_runs_from_step_0_to_the_last(self):
        born = network(np.zeros((3, 2)), [(0, 1), (1, 2)], births=[0, 0, 9])
        found, key = colors(born, "age")
        assert found == [key.colors[0], key.colors[-1]]
        assert key.labels == ("0", "9")

    def test_halves_have_the_age_and_the_source_of_the_whole(self):
        halves = halved(NET, {1})
        for color in ("age", "source"):
            whole, half = colors(NET, color)[0], colors(halves, color)[0]
            assert half == [whole[0], whole[1], whole[1], whole[2], whole[3]]

    def test_orders_beyond_the_last_colour_share_it(self):
        # a stair of nine veins, each off the middle of the last and a third as wide
        points, pairs, widths = [(0.0, 0.0)], [], []
        for depth in range(9):
            base = np.array(points[-1])
            along = np.array([(0.0, 1.0), (1.0, 0.0)][depth % 2])
            start, end = len(points) - 1, len(points)
            points += [tuple(base + 2.0 * along), tuple(base + along)]
            pairs += [(start, end + 1), (end + 1, end)]
            widths += [3.0**-depth] * 2
        net = network(np.array(points), pairs)
        found = color_segments(net, Paint("order", LeafStyle(), 9), descent(net), np.array(widths))
        assert found.key.title == "vein order"
        assert found.key.labels[-1] == "7+"
        assert found.classes.max() == 6


def test_gradient_passes_through_its_colours():
    assert gradient(("#000000", "#ff0000", "#ffffff"), 5) == (
        "#000000",
        "#800000",
        "#ff0000",
        "#ff8080",
        "#ffffff",
    )
