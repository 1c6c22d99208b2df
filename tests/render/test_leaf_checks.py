"""Pictures of the checks of leaves."""

import numpy as np
import pytest
from matplotlib.colors import to_hex
from reference.leaf_samples import small_report

from vasc.errors import OutputError
from vasc.render import draw_leaf_check, draw_leaf_checks, save_leaf_checks
from vasc.render.leaf_checks import _PICTURES
from vasc.render.leaf_panels import FAIL, looks
from vasc.render.styles import TEXT_SIZE
from vasc.validation.vein_statistics.checks import as_table, check_numbers


@pytest.fixture(scope="module")
def suite():
    report = small_report()
    return report.as_suite() | {
        "checks": as_table([*report.checks, *check_numbers(report.samples[-1])])
    }


@pytest.mark.parametrize("number", list(_PICTURES))
def test_each_check_has_a_picture_that_names_what_it_shows(suite, number):
    figure = draw_leaf_check(suite, number)
    assert f"Check {number}" in figure.get_suptitle()
    assert len(figure.axes) == len(_PICTURES[number][1])
    for ax in figure.axes:
        assert ax.get_xlabel()


def test_distributions_are_drawn_as_they_are(suite):
    (areas, *_) = draw_leaf_check(suite, 7).axes
    real, simulated = sorted(areas.patches, key=lambda patch: patch.get_fill(), reverse=True)
    shares = suite["distributions"]["area"]["shares"]
    assert real.get_data().values.tolist() == shares["Dalbergia"]
    assert simulated.get_data().values.tolist() == shares["honeycomb"]


def test_one_sheet_holds_all(suite):
    figure = draw_leaf_checks(suite)
    titles = {int(ax.get_title(loc="left").split()[1]) for ax in figure.axes}
    assert titles == set(_PICTURES)


def test_a_folder_gets_a_picture_a_check(suite, tmp_path):
    paths = save_leaf_checks(suite, tmp_path)
    assert sorted(tmp_path.iterdir()) == sorted(paths)
    assert len(paths) == len(_PICTURES)


def test_another_suffix_is_refused(suite, tmp_path):
    with pytest.raises(OutputError, match="suffix"):
        save_leaf_checks(suite, tmp_path / "leaves.txt")


def test_a_check_that_fails_is_framed_and_says_value_and_range(suite):
    failed = [one for one in suite["checks"] if one["check"] == 7 and not one["pass"]]
    assert failed
    for ax, panel in zip(draw_leaf_check(suite, 7).axes, _PICTURES[7][1], strict=True):
        missed = [one for one in panel.checks(suite, 7) if not one["pass"]]
        title = ax.get_title(loc="left")
        assert title.startswith("check 7 FAILS" if missed else "check 7")
        assert (to_hex(ax.spines["top"].get_edgecolor()) == FAIL) == bool(missed)
        assert ax.spines["top"].get_visible() == bool(missed)
        for one in missed:
            assert f"{one['value']:.3g}, asked {one['low']:.3g} to {one['high']:.3g}" in title


def test_every_check_belongs_to_a_panel(suite):
    for one in suite["checks"]:
        panels = _PICTURES[one["check"]][1]
        assert any(one in panel.checks(suite, one["check"]) for panel in panels), one["what"]


def test_words_and_numbers_along_the_axes_can_be_read(suite):
    for ax in draw_leaf_checks(suite).axes:
        if ax.axison:
            words = [ax.xaxis.label, ax.yaxis.label, *ax.get_xticklabels(), *ax.get_yticklabels()]
            assert min(text.get_fontsize() for text in words) >= TEXT_SIZE


def test_a_sheet_of_leaves_without_growth_or_a_tree_leaves_their_panels_out(suite):
    checks = [one for one in suite["checks"] if one["check"] not in (14, 15, 17)]
    curves = suite["curves"] | {"densities": {}}
    less = suite | {"exponents": [], "curves": curves, "checks": checks}
    titles = {ax.get_title(loc="left").split()[1] for ax in draw_leaf_checks(less).axes}
    assert not titles & {"14", "15", "17"}
    assert "13" in titles


def test_more_leaves_than_colors_look_different(suite):
    names = [f"leaf {k}" for k in range(9)]
    curves = {"degrees": dict.fromkeys([*names, "real"]), "real": ["real"]}
    assert len(set(looks({"curves": curves}).values())) == 10


def drawn_colors(figure):
    """Give the colours of what is drawn in the panels, of lines and of surfaces."""
    return {
        to_hex(one.get_facecolor())
        for ax in figure.axes
        for one in ax.patches
        if one.get_fill() and one is not ax.patch
    }


def test_the_key_of_murrays_law_names_its_colour(suite):
    figure = draw_leaf_check(suite, 14)
    (key,) = figure.legends
    named = {to_hex(handle.get_color()) for handle in key.legend_handles}
    assert drawn_colors(figure) == named
    assert [text.get_text() for text in key.get_texts()] == ["honeycomb (open venation)"]


def test_densities_without_minor_veins_in_the_end_are_drawn(suite):
    one = suite["curves"]["densities"]["honeycomb"]
    none = suite["curves"] | {"densities": {"honeycomb": one | {"minor": [1.0] * 7 + [0.0]}}}
    (ax,) = draw_leaf_check(suite | {"curves": none}, 15).axes
    major, minor = ax.lines[:2]
    assert np.isfinite(major.get_ydata()).all()
    assert np.isnan(minor.get_ydata()).all()


def test_an_open_check_is_neither_framed_nor_counted_as_failed(suite):
    checks = [
        one | {"value": None, "pass": None} if one["leaf"] == "honeycomb" else one
        for one in suite["checks"]
    ]
    figure = draw_leaf_check(suite | {"checks": checks}, 11)
    (ax,) = figure.axes
    assert ax.get_title(loc="left") == "check 11, open for honeycomb"
    assert "honeycomb: none" in [text.get_text() for text in ax.get_yticklabels()]
    sheet = draw_leaf_checks(suite | {"checks": checks})
    assert "cannot be decided" in sheet.get_suptitle()


@pytest.mark.parametrize("number", [12, 13])
def test_the_symbol_of_a_largest_number_is_whole(suite, number):
    controls = {
        name: {key: None if value is None else 0.9 + 1e-3 * row for key, value in one.items()}
        for row, (name, one) in enumerate(suite["curves"]["controls"].items())
    }
    alike = suite | {"curves": suite["curves"] | {"controls": controls}}
    n_drawn = 0
    for ax in draw_leaf_check(alike, number).axes:
        if not ax.get_xlabel().endswith("open: widths shuffled"):
            continue
        points = ax.figure.dpi / 72.0
        right = ax.get_window_extent().x1
        for line in ax.lines:
            if line.get_marker() in "osDv^":
                places = ax.transData.transform(line.get_xydata())[:, 0]
                reach = (line.get_markersize() + line.get_markeredgewidth()) / 2.0
                assert places.max() + reach * points <= right
                n_drawn += 1
    assert n_drawn


def test_densities_are_drawn_over_what_the_check_asks(suite):
    wider = [
        one | ({"low": 0.0, "high": 0.4} if one["what"].startswith("minor vein") else {})
        for one in suite["checks"]
    ]
    (ax,) = draw_leaf_check(suite | {"checks": wider}, 15).axes
    (band,) = ax.collections
    heights = band.get_paths()[0].vertices[:, 1]
    assert (heights.min(), heights.max()) == pytest.approx((0.6, 1.4))
