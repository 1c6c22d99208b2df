"""Pictures in files."""

import numpy as np
import pytest
from PIL import Image
from reference.recordings import Recording

from vasc.config import load
from vasc.errors import OutputError, VascError
from vasc.experiment import run
from vasc.render import PICTURE_SUFFIXES, render
from vasc.timeline import Timeline

SIGNATURES = {".png": b"\x89PNG", ".svg": b"<?xml", ".pdf": b"%PDF"}


def opened(path):
    with Image.open(path) as picture:
        return picture.convert("RGB")


@pytest.mark.parametrize("suffix", PICTURE_SUFFIXES)
def test_two_renders_give_the_same_bytes(tmp_path, suffix):
    first = render(Recording(), tmp_path / f"first{suffix}").read_bytes()
    second = render(Recording(), tmp_path / f"second{suffix}").read_bytes()
    assert first == second
    assert first.startswith(SIGNATURES[suffix])


@pytest.mark.parametrize("suffix", PICTURE_SUFFIXES)
def test_no_date_is_written(tmp_path, suffix):
    picture = render(Recording(), tmp_path / f"leaf{suffix}").read_bytes()
    assert b"CreationDate" not in picture
    assert b"dc:date" not in picture


def test_longer_side_has_the_pixels_asked_for(tmp_path):
    for pixels in (400, 1600):
        assert max(opened(render(Recording(), tmp_path / "leaf.png", pixels=pixels)).size) == pixels


def test_a_step_is_drawn_as_it_was(tmp_path):
    early = render(Recording(), tmp_path / "early.png", step=0).read_bytes()
    late = render(Recording(), tmp_path / "late.png").read_bytes()
    assert early != late


def test_steps_stand_side_by_side_at_one_scale(tmp_path):
    both = render(Recording(), tmp_path / "both.png", steps=[0, 2], pixels=600)
    picture = np.asarray(opened(both)).astype(int)
    is_green = (picture[:, :, 1] > picture[:, :, 0] + 4) & (picture[:, :, 1] > 200)
    columns = np.flatnonzero(is_green.any(axis=0))
    gap = int(np.argmax(np.diff(columns)))
    small, large = columns[gap] - columns[0], columns[-1] - columns[gap + 1]
    assert small / large == pytest.approx(0.5, abs=0.02)


def test_widths_come_from_the_config(tmp_path):
    thin = render(Recording(), tmp_path / "thin.png").read_bytes()
    config = {"widths": {"tip_radius": 0.3, "exponent": 1.0}}
    thick = render(Recording(config=config), tmp_path / "thick.png").read_bytes()
    assert thin != thick


@pytest.mark.parametrize("name", ["leaf.gif", "leaf", "leaf.jpeg"])
def test_unknown_suffix_names_the_known_ones(tmp_path, name):
    with pytest.raises(OutputError, match=r"is not one of \.png, \.svg, \.pdf"):
        render(Recording(), tmp_path / name)
    assert list(tmp_path.iterdir()) == []


def test_missing_folder_is_named(tmp_path):
    with pytest.raises(OutputError, match="nowhere does not exist"):
        render(Recording(), tmp_path / "nowhere" / "leaf.png")


def test_no_file_is_left_behind_by_an_error(tmp_path):
    with pytest.raises(VascError):
        render(Recording(), tmp_path / "leaf.png", color="blue")
    with pytest.raises(VascError, match="at least one step"):
        render(Recording(), tmp_path / "leaf.png", steps=[])
    assert list(tmp_path.iterdir()) == []


def n_seeds(file):
    """Count the strokes in the colour of a seed in an svg."""
    return file.read_text().count("stroke: #b3261e")


def test_seeds_are_marked_while_there_is_hardly_a_vein(tmp_path):
    experiment = load("poplar-leaf")
    run(experiment, tmp_path / "leaf.h5", steps=60)
    first = render(tmp_path / "leaf.h5", tmp_path / "first.svg", step=0)
    assert n_seeds(first) > 0
    with Timeline(tmp_path / "leaf.h5") as timeline:
        last = timeline.frame()
        assert last.network.lengths.sum() > 0.1 * last.blade.length
    late = render(tmp_path / "leaf.h5", tmp_path / "late.svg")
    assert n_seeds(late) == 0
