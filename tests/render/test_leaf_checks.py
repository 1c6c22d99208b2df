"""Pictures of the checks of leaves."""

import pytest
from reference.leaf_samples import small_report

from vasc.errors import OutputError
from vasc.render import draw_leaf_check, draw_leaf_checks, save_leaf_checks
from vasc.render.leaf_checks import _PICTURES
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
    titles = {ax.get_title(loc="left") for ax in figure.axes} - {""}
    assert titles == {f"check {number}" for number in _PICTURES}


def test_a_folder_gets_a_picture_a_check(suite, tmp_path):
    paths = save_leaf_checks(suite, tmp_path)
    assert sorted(tmp_path.iterdir()) == sorted(paths)
    assert len(paths) == len(_PICTURES)


def test_another_suffix_is_refused(suite, tmp_path):
    with pytest.raises(OutputError, match="suffix"):
        save_leaf_checks(suite, tmp_path / "leaves.txt")
