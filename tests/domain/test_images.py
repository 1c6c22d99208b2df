"""Outlines of leaves on masks and scans."""

import numpy as np
import pytest
import shapely
from PIL import Image

from vasc.domain import read_outline
from vasc.domain.shapes import Cordate
from vasc.errors import OutlineError

SIDE = 400
ROWS, COLUMNS = np.mgrid[0:SIDE, 0:SIDE]
HEART = Cordate(tip=0.3).outline(800)
# attachment 100 px above the lower border, 250 px high
AT, HEIGHT = np.array([200.0, 300.0]), 250.0


def heart():
    """Draw the pixels of a heart: True inside."""
    x, y = (COLUMNS - AT[0]) / HEIGHT, (AT[1] - ROWS) / HEIGHT
    inside = shapely.contains_xy(shapely.Polygon(HEART), x.ravel(), y.ravel())
    return inside.reshape(SIDE, SIDE)


def as_mask():
    return Image.fromarray(heart().astype(np.uint8) * 255)


def as_black_and_white():
    return as_mask().convert("1")


def as_dark_leaf():
    return Image.fromarray(np.where(heart(), 40, 230).astype(np.uint8))


def as_scan():
    rng = np.random.default_rng(3)
    ground, leaf = np.array([225.0, 225.0, 215.0]), np.array([70.0, 120.0, 50.0])
    picture = np.where(heart()[..., None], leaf, ground) + rng.normal(0.0, 12.0, (SIDE, SIDE, 3))
    # a light vein, and dirt beside the leaf
    picture[180:285, 199:202] = 220.0
    picture[20:24, 20:24] = 30.0
    return Image.fromarray(np.clip(picture, 0, 255).astype(np.uint8))


def as_transparent():
    opacity = heart().astype(np.uint8) * 255
    grey = np.full((SIDE, SIDE), 90, dtype=np.uint8)
    return Image.fromarray(np.stack([grey, grey, grey, opacity], axis=2))


def as_sixteen_bits():
    return Image.fromarray(np.where(heart(), 50_000, 3_000).astype(np.uint16))


PICTURES = {
    "mask.png": as_mask,
    "mask.tif": as_mask,
    "bits.png": as_black_and_white,
    "dark.png": as_dark_leaf,
    "scan.jpg": as_scan,
    "scan.png": as_scan,
    "transparent.png": as_transparent,
    "deep.tiff": as_sixteen_bits,
    "deep.png": as_sixteen_bits,
}


@pytest.mark.parametrize("name", PICTURES)
def test_a_picture_gives_the_leaf_upright(name, tmp_path):
    PICTURES[name]().save(tmp_path / name)
    (ring,) = read_outline(tmp_path / name, attachment=(200.0, 300.0))
    found, drawn = shapely.Polygon(ring), shapely.Polygon(HEART)
    assert found.symmetric_difference(drawn).area < 0.02 * drawn.area
    # within two pixels everywhere but at the sharp tip and sinus, which pixels cannot show
    assert shapely.hausdorff_distance(found.buffer(0), drawn) < 0.05
    assert 40 < len(ring) < 1500


def test_several_parts_and_holes_are_kept_and_specks_are_not(tmp_path):
    pixels = np.zeros((200, 300), dtype=np.uint8)
    pixels[20:180, 20:120] = 255
    pixels[60:100, 50:90] = 0
    pixels[30:150, 180:260] = 255
    pixels[5:8, 5:8] = 255
    pixels[120:123, 40:43] = 0
    Image.fromarray(pixels).save(tmp_path / "parts.png")
    rings = read_outline(tmp_path / "parts.png")
    areas = sorted(shapely.Polygon(ring).area * 160.0**2 for ring in rings)
    assert areas == pytest.approx([40 * 40, 120 * 80, 160 * 100], rel=0.02)


def test_a_leaf_that_touches_the_border_is_closed_there(tmp_path):
    pixels = np.zeros((100, 100), dtype=np.uint8)
    pixels[30:100, 40:60] = 255
    Image.fromarray(pixels).save(tmp_path / "cut.png")
    (ring,) = read_outline(tmp_path / "cut.png")
    assert shapely.Polygon(ring).area == pytest.approx(20 / 70, rel=0.05)


@pytest.mark.parametrize(("grey", "said"), [(0, "one grey only"), (200, "one grey only")])
def test_a_picture_of_nothing_is_refused(grey, said, tmp_path):
    Image.new("L", (50, 50), grey).save(tmp_path / "nothing.png")
    with pytest.raises(OutlineError, match=said):
        read_outline(tmp_path / "nothing.png")


def test_without_scikit_image_the_remedy_is_named(tmp_path, monkeypatch):
    import sys

    as_mask().save(tmp_path / "mask.png")
    monkeypatch.setitem(sys.modules, "skimage", None)
    with pytest.raises(OutlineError, match=r'pip install "vasc\[image\]"'):
        read_outline(tmp_path / "mask.png")
