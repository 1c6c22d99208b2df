"""Pictures of growth: every panel is there, at scale, with its numbers."""

import numpy as np
import pytest

from vasc.domain import Blade
from vasc.errors import VascError
from vasc.render import GrownGrid, GrowthMap, draw_growth, save

SQUARE = np.array([[-1.0, 0.0], [1.0, 0.0], [1.0, 2.0], [-1.0, 2.0]])


def grid_of(step, factor):
    """Give a square leaf with a grid, so many times as large."""
    x, y = np.meshgrid(np.linspace(-1.0, 1.0, 11), np.linspace(0.0, 2.0, 21))
    points = factor * np.stack([x, y], axis=2)
    return GrownGrid(step, Blade.from_rings([factor * SQUARE]), points)


def map_of(start, grid, areal, anisotropy):
    """Give a map of growth that is stronger to the tip."""
    rise = np.linspace(0.0, 1.0, 21)[:, None] * np.ones(11)
    directions = np.broadcast_to([0.0, 1.0], (21, 11, 2))
    return GrowthMap(start, grid, areal * rise, 1.0 + (anisotropy - 1.0) * rise, directions)


GRIDS = [grid_of(0, 1.0), grid_of(50, 8.0), grid_of(100, 40.0)]
MAPS = [map_of(0, GRIDS[1], 0.08, 2.0), map_of(50, GRIDS[2], 0.02, 1.0)]


def texts(figure):
    """Give all words of a figure."""
    found = [text.get_text() for text in figure.texts]
    for axes in figure.axes:
        found += [text.get_text() for text in axes.texts] + [axes.get_ylabel()]
    return found


def scale_of(axes):
    """Give the scale of axes, across and up, in inches per D."""
    position, (width, height) = axes.get_position(), axes.figure.get_size_inches()
    across, up = np.ptp(axes.get_xlim()), np.ptp(axes.get_ylim())
    return position.width * width / across, position.height * height / up


def test_every_panel_says_what_it_shows():
    found = texts(draw_growth(GRIDS, MAPS))
    for words in (
        *("step 0", "step 50", "step 100", "steps 0 to 50", "steps 50 to 100"),
        *("material grid", "growth of area", "anisotropy"),
        *("growth of area (% per step)", "greatest / least stretch"),
    ):
        assert words in found
    # one bar for the grids, one for each map
    assert sum(text.endswith(" D") for text in found) == 5


def test_grids_have_one_scale_and_stand_on_one_line():
    figure = draw_growth(GRIDS, MAPS)
    scales = [scale_of(axes) for axes in figure.axes[:3]]
    np.testing.assert_allclose(scales, scales[0][0], rtol=1e-9)
    assert len({round(axes.get_ylim()[0], 9) for axes in figure.axes[:3]}) == 1
    for axes in figure.axes[:5]:
        across, up = scale_of(axes)
        assert across == pytest.approx(up, rel=1e-9)


def test_panels_do_not_overlap_and_hold_their_leaves():
    figure = draw_growth(GRIDS, MAPS)
    shown = [*GRIDS, GRIDS[1], GRIDS[2]]
    for axes, grid in zip(figure.axes[:5], shown, strict=True):
        left, right = axes.get_xlim()
        bottom, top = axes.get_ylim()
        x0, y0, x1, y1 = grid.blade.bounds
        assert left <= x0 < x1 <= right
        assert bottom <= y0 < y1 <= top
    boxes = [axes.get_position() for axes in figure.axes]
    for row, box in enumerate(boxes):
        for other in boxes[row + 1 :]:
            apart_across = box.x1 <= other.x0 + 1e-9 or other.x1 <= box.x0 + 1e-9
            apart_up = box.y1 <= other.y0 + 1e-9 or other.y1 <= box.y0 + 1e-9
            assert apart_across or apart_up


def test_maps_of_a_row_have_one_colour_scale():
    figure = draw_growth(GRIDS, MAPS)
    meshes = [axes.collections[0] for axes in figure.axes if axes.collections]
    norms = [mesh.norm for mesh in meshes if mesh.get_array() is not None]
    limits = [(norm.vmin, norm.vmax) for norm in norms]
    areal, anisotropy = (0.0, pytest.approx(8.0, rel=0.05)), (1.0, pytest.approx(2.0, rel=0.05))
    assert areal in limits
    assert anisotropy in limits
    assert len(set(limits)) == 2


def test_shrinking_tissue_has_colours_about_zero():
    shrinking = map_of(0, GRIDS[1], -0.02, 1.0)
    figure = draw_growth(GRIDS[:2], [shrinking])
    meshes = [axes.collections[0] for axes in figure.axes if axes.collections]
    norms = [mesh.norm for mesh in meshes if mesh.get_array() is not None]
    assert any(norm.vmin == -norm.vmax for norm in norms)


def test_one_step_has_a_grid_only():
    figure = draw_growth(GRIDS[:1], [], units={"length": "um", "segment": 4.0})
    assert len(figure.axes) == 1
    assert any(text.endswith(" µm") or text.endswith(" um") for text in texts(figure))


def test_equal_growth_gives_equal_files(tmp_path):
    for name in ("a.png", "b.png", "a.svg", "b.svg"):
        save(draw_growth(GRIDS, MAPS), tmp_path / name)
    assert (tmp_path / "a.png").read_bytes() == (tmp_path / "b.png").read_bytes()
    assert (tmp_path / "a.svg").read_bytes() == (tmp_path / "b.svg").read_bytes()


def test_no_step_is_refused():
    with pytest.raises(VascError, match="at least one step"):
        draw_growth([], [])
