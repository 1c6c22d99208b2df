"""Pictures of tissues."""

from dataclasses import dataclass, replace

import numpy as np
import pytest
from PIL import Image
from reference.networks import network, sources

from vasc.config import load
from vasc.domain.tilings import hexagonal, rectangular
from vasc.errors import VascError
from vasc.experiment import run
from vasc.fields import Fields, Role
from vasc.render import TISSUE_COLOR_CHOICES, animate, draw_tissue, render, save, scale_of
from vasc.render.cells import arrows, bars, leaves_from, wall_ends
from vasc.render.tissue_style import shades_of
from vasc.timeline import Timeline


@dataclass(frozen=True)
class Cells:
    """A row of cells at one step: auxin flows from the first to the last."""

    tissue: object
    fields: Fields
    step: int = 3
    time: float = 1.5

    @property
    def blade(self):
        return self.tissue.blade

    @property
    def network(self):
        return network(self.tissue.positions[-1:], [])

    @property
    def sources(self):
        return sources(self.tissue.positions[:1], [0])


def row_of_cells(columns=12, rows=4, polar=True):
    """Flux from left to right through the lowest row, its carriers where it leaves a cell."""
    tissue = rectangular(columns, rows)
    is_along = (tissue.walls[:, 1] - tissue.walls[:, 0] == 1) & (tissue.walls[:, 1] < columns)
    carriers = np.ones((tissue.n_walls, 2))
    carriers[is_along, 0] = 10.0
    if not polar:
        carriers[is_along, 1] = 10.0
    roles = np.zeros(tissue.n_cells, dtype=np.int8)
    roles[0], roles[columns - 1] = Role.SOURCE, Role.VEIN
    concentration = np.zeros(tissue.n_cells)
    concentration[:columns] = np.linspace(2.0, 0.0, columns)
    fields = Fields(concentration, np.where(is_along, 1.0, 0.0), carriers, roles)
    return Cells(tissue, fields)


@dataclass
class TissueRecording:
    """A run of three steps, as pictures and films ask for it."""

    moment: Cells
    config: dict
    units: dict | None = None
    dimensions: int = 2
    last_step: int = 2

    @property
    def tissue(self):
        return self.moment.tissue

    def frame(self, step=-1):
        step = self.last_step if step == -1 else step
        grown = self.moment.fields._replace(
            concentration=self.moment.fields.concentration * (1 + step)
        )
        return replace(self.moment, fields=grown, step=step)


def recording(columns=12, rows=4):
    return TissueRecording(row_of_cells(columns, rows), {"transport": {"kind": "pool"}})


def pixels_of(moment, path, **options):
    save(draw_tissue(moment, **options), path)
    with Image.open(path) as picture:
        return np.asarray(picture.convert("RGB")).astype(int)


def is_like(pixels, color, within=40):
    wanted = np.array([int(color[i : i + 2], 16) for i in (1, 3, 5)])
    return np.abs(pixels - wanted).sum(axis=2) < within


class TestShapes:
    @pytest.mark.parametrize("tissue", [rectangular(5, 4), hexagonal(5, 4)])
    def test_the_ends_of_a_wall_are_corners_of_both_cells(self, tissue):
        ends = wall_ends(tissue)
        lengths = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
        assert np.allclose(lengths, tissue.lengths)
        for side in (0, 1):
            for wall in range(tissue.n_walls):
                corners = tissue.polygons[tissue.walls[wall, side]]
                for end in ends[wall]:
                    assert np.linalg.norm(corners - end, axis=1).min() < 1e-9

    def test_an_arrow_points_where_auxin_goes(self):
        (shape,) = arrows(np.array([[0.0, 0.0]]), np.array([[0.0, 2.0]]), np.array([0.2]))
        assert shape[:, 1].max() == pytest.approx(1.62)
        assert shape[shape[:, 1].argmax(), 0] == pytest.approx(0.0)
        assert shape[:, 1].min() == pytest.approx(0.38)

    def test_auxin_of_negative_flux_leaves_the_second_cell(self):
        walls = np.array([[0, 1], [1, 2]], dtype=np.int32)
        left, entered = leaves_from(walls, np.array([1.0, -1.0]))
        assert left.tolist() == [0, 2]
        assert entered.tolist() == [1, 1]

    @pytest.mark.parametrize("centre", [(0.0, 0.0), (1.0, 0.0)])
    def test_a_bar_lies_in_its_cell(self, centre):
        ends = np.array([[[0.5, -0.5], [0.5, 0.5]]])
        (bar,) = bars(ends, np.array([centre]), np.array([0.1]))
        toward = np.sign(centre[0] - 0.5)
        assert ((bar[:, 0] - 0.5) * toward > 0.0).all()
        assert np.abs(bar[:, 0] - 0.5).max() == pytest.approx(0.13)


class TestScale:
    def test_it_holds_the_most_of_all_steps(self):
        moments = [recording().frame(step) for step in (0, 2)]
        scale = scale_of(moments)
        alone = scale_of(moments[:1])
        assert scale.shade == pytest.approx(3.0 * alone.shade)
        assert scale.flux == 1.0
        assert scale.carriers == 10.0

    def test_a_tissue_without_auxin_has_one(self):
        moment = row_of_cells()
        fields = moment.fields
        empty = fields._replace(
            concentration=0 * fields.concentration,
            flux=0 * fields.flux,
            carriers=0 * fields.carriers,
        )
        assert scale_of([replace(moment, fields=empty)]).shade == 1.0

    def test_flux_through_a_cell_is_what_leaves_it(self):
        shades = shades_of(row_of_cells(), "flux")
        assert shades[:11].tolist() == [1.0] * 11
        assert shades[11:].sum() == 0.0

    def test_carriers_are_those_of_the_side_of_a_cell(self):
        shades = shades_of(row_of_cells(), "carriers")
        # three walls of the first cell of the row above, two of the corner: one has 10
        assert shades[0] == 11.0
        assert shades[11] == 2.0

    def test_a_permeability_is_not_added_up(self):
        assert shades_of(row_of_cells(polar=False), "carriers").max() == 10.0


class TestPicture:
    def test_the_more_auxin_the_darker(self, tmp_path):
        pixels = pixels_of(row_of_cells(), tmp_path / "a.png", flows=False)
        rows, columns = np.nonzero(is_like(pixels, "#08306b", 30))
        below = rows > pixels.shape[0] / 2
        assert columns[below & (columns < pixels.shape[1] / 4)].size > 500

    def test_arrows_are_drawn_along_the_flux_alone(self, tmp_path):
        pixels = pixels_of(row_of_cells(), tmp_path / "a.png")
        rows, columns = np.nonzero(is_like(pixels, "#e8590c"))
        assert len(rows) > 500
        height, width = pixels.shape[:2]
        assert np.ptp(rows) < height / 4
        assert np.ptp(columns) > 0.8 * width

    def test_bars_are_on_one_side_by_carriers_and_on_both_by_permeability(self):
        def n_bars(moment):
            drawn = draw_tissue(moment).axes[0].collections
            black = [one for one in drawn if np.allclose(one.get_facecolor()[0, :3], 16 / 255)]
            return sum(len(one.get_paths()) for one in black)

        assert n_bars(row_of_cells()) == 11
        assert n_bars(row_of_cells(polar=False)) == 22
        rest = row_of_cells()
        ones = np.ones_like(rest.fields.carriers)
        assert n_bars(replace(rest, fields=rest.fields._replace(carriers=ones))) == 0

    def test_sources_and_sinks_have_rings(self, tmp_path):
        pixels = pixels_of(row_of_cells(), tmp_path / "a.png")
        assert is_like(pixels, "#d3122e").sum() > 100
        assert is_like(pixels, "#1b9e3e").sum() > 100

    def test_fine_cells_have_no_outline_and_lines_instead_of_arrows(self, tmp_path):
        large = pixels_of(row_of_cells(30, 15), tmp_path / "b.png")
        assert is_like(large, "#b9bec4", 20).sum() > 5000
        moment = row_of_cells(300, 150)
        pixels = pixels_of(moment, tmp_path / "a.png")
        assert is_like(pixels, "#b9bec4", 20).sum() < 500
        assert is_like(pixels, "#e8590c").sum() > 1000

    @pytest.mark.parametrize("color", TISSUE_COLOR_CHOICES)
    def test_each_color_gives_another_picture(self, color, tmp_path):
        plain = pixels_of(row_of_cells(), tmp_path / "a.png", flows=False)
        other = pixels_of(row_of_cells(), tmp_path / "b.png", flows=False, color=color)
        assert plain.shape == other.shape
        assert (plain != other).any() == (color != "concentration")

    def test_unknown_colors_name_the_known_ones(self):
        with pytest.raises(VascError, match="'age' is not one of concentration, flux"):
            draw_tissue(row_of_cells(), color="age")

    def test_a_run_without_cells_is_refused(self):
        moment = row_of_cells()

        class Plain:
            tissue = fields = None
            blade = moment.blade

        with pytest.raises(VascError, match="no cells"):
            draw_tissue(Plain())

    def test_words_above_tell_step_and_time(self):
        figure = draw_tissue(row_of_cells())
        words = [text.get_text() for text in figure.axes[0].texts]
        assert "step 3, time 1.5" in words


class TestFiles:
    def test_auxin_is_drawn_unless_veins_are_asked_for(self, tmp_path):
        plain = render(recording(), tmp_path / "a.png").read_bytes()
        auxin = render(recording(), tmp_path / "b.png", color="concentration").read_bytes()
        veins = render(recording(), tmp_path / "c.png", color="order").read_bytes()
        assert plain == auxin
        assert plain != veins

    def test_the_key_tells_the_unit(self):
        from vasc.render.tissue_files import draw_steps

        run = recording()
        figure = draw_steps(run, [run.frame()], color="concentration")
        assert "5.9 K/T" in [text.get_text() for text in figure.axes[0].texts]

    @pytest.mark.parametrize("shape", [(12, 4), (4, 12)])
    def test_the_longer_side_has_the_pixels_asked_for(self, tmp_path, shape):
        with Image.open(render(recording(*shape), tmp_path / "a.png", pixels=800)) as picture:
            assert max(picture.size) == 800

    def test_steps_stand_side_by_side(self, tmp_path):
        with Image.open(render(recording(), tmp_path / "a.png", steps=[0, 2], pixels=400)) as both:
            assert both.size[0] == 800

    def test_a_color_of_tissues_is_refused_for_a_leaf(self, tmp_path):
        from reference.recordings import Recording

        with pytest.raises(VascError, match="'flux' is not one of width"):
            render(Recording(), tmp_path / "a.png", color="flux")

    def test_a_film_shows_all_steps(self, tmp_path):
        told = []
        film = animate(
            recording(),
            tmp_path / "a.gif",
            progress=lambda count, total: told.append((count, total)),
        )
        with Image.open(film) as pictures:
            assert pictures.n_frames == 3
        assert told == [(1, 3), (2, 3), (3, 3)]

    def test_a_gif_keeps_the_colors_of_rings(self, tmp_path):
        with Image.open(animate(recording(30, 15), tmp_path / "a.gif")) as pictures:
            first = np.asarray(pictures.convert("RGB")).astype(int)
        assert is_like(first, "#d3122e", 12).sum() > 20
        assert is_like(first, "#1b9e3e", 12).sum() > 20


def test_roles_are_those_after_the_last_strand_became_vein(tmp_path):
    output = tmp_path / "run.h5"
    run(load("mitchison-two-sinks-left"), output)
    with Timeline(output) as timeline:
        frame = timeline.frame()
        assert (frame.fields.roles == Role.VEIN).sum() == 2
        shown = shades_of(frame, "role")
        cells = frame.tissue.nearest_cells(frame.network.positions)
        assert len(cells) > 10
        assert (shown[cells] == Role.VEIN).all()
        assert (shown == Role.VEIN).sum() == len(cells)
        assert not (shown == Role.SOURCE).any()
        # in the step before, the source was one
        assert (shades_of(timeline.frame(timeline.last_step - 1), "role") == Role.SOURCE).sum() == 1
