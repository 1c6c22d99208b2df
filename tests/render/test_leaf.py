"""Pictures looked at by the pixel."""

import numpy as np
import pytest
from reference.networks import PlainBlade, PlainMoment, network, sources
from reference.recordings import cross_leaf

from vasc.analysis import WidthParameters
from vasc.errors import VascError
from vasc.render import COLOR_CHOICES, LeafStyle, draw_leaf
from vasc.render.leaf import view_of
from vasc.render.surroundings import bar_length

STYLE = LeafStyle(blade="#00ff00", vein="#000000", margin="#00ff00")
GREEN, BLACK, WHITE = (0, 255, 0), (0, 0, 0), (255, 255, 255)
RED, ORANGE = (0xC8, 0x10, 0x2E), (0xF0, 0x8A, 0x24)


def look(figure, view, place):
    """The colour of a picture at a place on the blade."""
    figure.set_dpi(400)
    figure.canvas.draw()
    pixels = np.asarray(figure.canvas.buffer_rgba())
    left, bottom, right, top = view.box
    column = (place[0] - left) / (right - left) * pixels.shape[1]
    row = (top - place[1]) / (top - bottom) * pixels.shape[0]
    return tuple(pixels[int(row), int(column), :3].tolist())


def draw(moment, **options):
    view = view_of(moment.blade, STYLE)
    return draw_leaf(moment, style=STYLE, view=view, **options), view


class TestLeaf:
    def test_blade_is_filled_veins_are_dark_paper_is_white(self):
        picture, view = draw(cross_leaf())
        assert look(picture, view, (3.0, 3.0)) == GREEN
        assert look(picture, view, (0.0, 2.5)) == BLACK
        assert look(picture, view, (2.0, 6.0)) == BLACK
        assert look(picture, view, (-5.15, 5.0)) == WHITE

    def test_the_midvein_is_wider_than_a_side_vein(self):
        picture, view = draw(cross_leaf(), widths=WidthParameters(tip_radius=0.1, exponent=1.0))
        # three veinlets: radius 0.3 below, 0.1 in the side vein
        assert look(picture, view, (0.25, 2.5)) == BLACK
        assert look(picture, view, (0.38, 2.5)) == GREEN
        assert look(picture, view, (0.25, 7.5)) == GREEN
        assert look(picture, view, (0.05, 7.5)) == BLACK

    def test_sources_show_only_if_asked_for(self):
        picture, view = draw(cross_leaf(), sources=True)
        assert look(picture, view, (-3.0, 2.0)) == RED
        assert look(picture, view, (3.0, 2.0)) == ORANGE
        picture, view = draw(cross_leaf())
        assert look(picture, view, (-3.0, 2.0)) == GREEN

    def test_holes_stay_empty_whichever_way_they_turn(self):
        outer = np.array([[-5.0, 0], [5, 0], [5, 10], [-5, 10]])
        hole = np.array([[-2.0, 4], [2, 4], [2, 8], [-2, 8]])
        veins = network([(0, 0), (0, 1)], [(0, 1)])
        for inner in (hole, hole[::-1]):
            blade = PlainBlade((outer, inner), 10.0)
            picture, view = draw(PlainMoment(veins, blade, sources()))
            assert look(picture, view, (0.0, 6.0)) == WHITE
            assert look(picture, view, (4.0, 6.0)) == GREEN

    def test_a_leaf_without_veins_is_a_blade(self):
        seed = PlainMoment(network([(0, 0)], []), cross_leaf().blade, sources())
        picture, view = draw(seed)
        assert look(picture, view, (0.0, 5.0)) == GREEN

    @pytest.mark.parametrize("color", COLOR_CHOICES)
    def test_every_colouring_draws_veins(self, color):
        picture, view = draw(cross_leaf(), color=color, scale_bar=False)
        assert look(picture, view, (0.0, 2.5)) not in (GREEN, WHITE)

    def test_orders_differ_in_colour(self):
        picture, view = draw(cross_leaf(), color="order")
        assert look(picture, view, (0.0, 2.5)) != look(picture, view, (2.0, 6.0))

    def test_unknown_colouring_is_refused(self):
        with pytest.raises(VascError, match="not one of width"):
            draw_leaf(cross_leaf(), color="blue")

    def test_it_draws_on_axes_of_others(self):
        from matplotlib.figure import Figure

        figure = Figure(figsize=(6, 3))
        left, right = figure.subplots(1, 2)
        assert draw_leaf(cross_leaf(), left) is figure
        assert len(left.collections) == 1
        assert len(right.collections) == 0


class TestView:
    @pytest.mark.parametrize(("width", "height"), [(10, 10), (30, 8), (5, 200), (400, 300)])
    def test_longer_side_is_as_asked(self, width, height):
        ring = np.array([[0, 0], [width, 0], [width, height], [0, height]], dtype=float)
        view = view_of(PlainBlade((ring,), float(height)), LeafStyle(), side=8.0)
        assert max(view.inches) == pytest.approx(8.0)
        assert min(view.inches) >= 1.2 - 1e-9
        left, bottom, right, top = view.box
        assert left < 0 < width < right
        assert bottom < 0 < height < top


class TestScaleBar:
    @pytest.mark.parametrize("extent", np.geomspace(1e-3, 1e5, 40))
    def test_length_is_round_and_fits(self, extent):
        length = bar_length(extent)
        assert 0.1 * extent <= length * 1.0001
        assert length <= 0.25 * extent * 1.0001
        mantissa = float(f"{length:.6e}".split("e")[0])
        assert mantissa in (1.0, 2.0, 5.0)

    def test_it_is_labelled_in_real_units(self):
        figure = draw_leaf(cross_leaf(), units={"length": "um", "segment": 10.0})
        assert [text.get_text() for text in figure.axes[0].texts] == ["20 µm"]

    def test_it_is_as_long_as_it_says(self):
        figure = draw_leaf(cross_leaf(), units={"length": "um", "segment": 10.0})
        (bar,) = figure.axes[0].lines
        assert np.ptp(bar.get_xdata()) == pytest.approx(2.0)


class TestSources:
    def test_dots_are_smaller_where_sources_are_dense(self):
        sizes = []
        for distance in (3.0, 0.1):
            places = np.arange(20.0)[:, None] * [distance / 20.0, 0.0] + [0.0, 3.0]
            moment = PlainMoment(cross_leaf().network, cross_leaf().blade, sources(places))
            figure, _ = draw(moment, sources=True, scale_bar=False)
            sizes.append(figure.axes[0].lines[0].get_markersize())
        assert LeafStyle().source_size >= sizes[0] > sizes[1] >= 0.8
