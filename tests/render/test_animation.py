"""Films."""

import sys

import numpy as np
import pytest
from PIL import Image
from reference.recordings import Recording

from vasc.errors import OutputError, VascError
from vasc.render import Film, animate
from vasc.render.animation import chosen_steps
from vasc.render.styles import LeafStyle

SHORT = Film(n_pictures=3, pictures_per_second=10, pixels=200, rest=0.2)


def test_a_gif_shows_the_steps_at_one_scale(tmp_path):
    told = []
    path = animate(
        Recording(), tmp_path / "leaf.gif", film=SHORT, progress=lambda *count: told.append(count)
    )
    assert told == [(1, 3), (2, 3), (3, 3)]
    heights = []
    with Image.open(path) as film:
        assert film.n_frames == 3
        for number in range(3):
            film.seek(number)
            picture = np.asarray(film.convert("RGB")).astype(int)
            is_green = (picture[:, :, 1] > picture[:, :, 0] + 4) & (picture[:, :, 1] > 200)
            heights.append(np.ptp(np.flatnonzero(is_green.any(axis=1))))
    assert np.array(heights) / heights[-1] == pytest.approx([0.5, 0.75, 1.0], abs=0.03)


def test_paper_and_blade_of_a_gif_have_their_colors_in_all_pictures(tmp_path):
    style = LeafStyle()
    with Image.open(animate(Recording(), tmp_path / "leaf.gif", film=SHORT)) as film:
        for number in range(3):
            film.seek(number)
            colors = film.convert("RGB").getcolors(1 << 24)
            common = {"#{:02x}{:02x}{:02x}".format(*color) for _, color in sorted(colors)[-2:]}
            assert common == {style.background, style.blade}


@pytest.mark.parametrize("suffix", [".gif", ".mp4"])
def test_two_films_have_the_same_bytes(tmp_path, suffix):
    first = animate(Recording(), tmp_path / f"first{suffix}", film=SHORT).read_bytes()
    second = animate(Recording(), tmp_path / f"second{suffix}", film=SHORT).read_bytes()
    assert first == second
    assert sorted(path.name for path in tmp_path.iterdir()) == [f"first{suffix}", f"second{suffix}"]


def test_an_mp4_holds_every_picture_and_the_rest(tmp_path):
    import imageio_ffmpeg

    path = animate(Recording(), tmp_path / "leaf.mp4", film=SHORT)
    n_pictures, seconds = imageio_ffmpeg.count_frames_and_secs(str(path))
    assert n_pictures == 5
    assert seconds == pytest.approx(0.5, abs=0.11)


def test_mp4_without_its_extra_says_what_to_install(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "imageio_ffmpeg", None)
    with pytest.raises(OutputError, match=r"vasc\[video\]"):
        animate(Recording(), tmp_path / "leaf.mp4", film=SHORT)


def test_unknown_suffix_and_bad_distance_are_refused(tmp_path):
    with pytest.raises(OutputError, match=r"not one of \.mp4, \.gif"):
        animate(Recording(), tmp_path / "leaf.avi")
    with pytest.raises(VascError, match="every: 0 is below 1"):
        animate(Recording(), tmp_path / "leaf.gif", every=0)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(("last", "n_pictures"), [(0, 5), (3, 10), (1000, 120), (7, 2)])
def test_steps_hold_the_first_and_the_last(last, n_pictures):
    steps = chosen_steps(last, n_pictures)
    assert (steps[0], steps[-1]) == (0, last)
    assert len(steps) == min(n_pictures, last + 1)
    assert (np.diff(steps) > 0).all()
