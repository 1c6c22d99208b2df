"""The outline of the leaf on a mask or scan, in pixels from the upper left corner, y downward."""

import io
import warnings
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from vasc.arrays import Points
from vasc.errors import OutlineError
from vasc.limits import IMAGE_PIXELS

if TYPE_CHECKING:
    from PIL.Image import Image

FORMATS = ("PNG", "TIFF", "JPEG")
LEAST_SHARE = 0.01
"""Spots and holes smaller than this share of the largest part are dirt or light veins."""
LONGEST_REASON = 120
"""Characters of a reason that a decoder gives."""
BLUR = 0.7
"""Standard deviation, in pixels, of the blur that takes the stairs off a mask."""
TOLERANCE = 0.25
"""Most that corners of the outline are moved when points between them are left out, in pixels."""


def rings_of_image(content: bytes) -> list[Points]:
    """Give the outline of what stands out from the border of an image.

    Parameters
    ----------
    content : bytes
        A PNG, TIFF or JPEG file: a mask, a scan on a plain ground, or a picture
        with a transparent ground.

    Returns
    -------
    list of ndarray of shape (n, 2), float64
        Parts and holes with at least a hundredth of the area of the largest part.

    Raises
    ------
    OutlineError
        If the file is no such image, is too large, shows nothing, or scikit-image
        is not installed.
    """
    try:
        from PIL import Image, UnidentifiedImageError
        from skimage import filters, measure
    except ImportError as error:
        raise OutlineError(
            'outline: images need scikit-image; install it with: pip install "vasc[image]"'
        ) from error
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        try:
            with Image.open(io.BytesIO(content), formats=FORMATS) as image:
                grey, is_mask = _grey(_of_allowed_size(image))
        except OutlineError:
            raise
        except UnidentifiedImageError as error:
            raise OutlineError("outline: not a PNG, TIFF or JPEG image") from error
        # a damaged file may make the decoder raise nearly anything
        except Exception as error:
            reason = " ".join(str(error).split())[:LONGEST_REASON]
            raise OutlineError(f"outline: not a PNG, TIFF or JPEG image: {reason}") from error
    leaf = _cleaned(_leaf(grey, is_mask))
    # a margin of ground around the image closes the outline of a leaf that touches its border
    ground = np.pad(leaf, 4).astype(np.float64)
    contours = measure.find_contours(filters.gaussian(ground, BLUR), 0.5)
    rings = []
    for contour in contours:
        ring = measure.approximate_polygon(contour, TOLERANCE)[:-1, ::-1] - 4.0
        if len(ring) >= 3:
            # the blur's last digits depend on the processor; a thousandth of a pixel does not
            rings.append(np.round(ring * 1024.0) / 1024.0)
    return rings


def _of_allowed_size(image: "Image") -> "Image":
    """Give the image back if its header claims a size that can be handled."""
    width, height = image.size
    if width * height > IMAGE_PIXELS:
        raise OutlineError(
            f"outline: the image has {width} x {height} pixels;"
            f" at most {IMAGE_PIXELS:,} are allowed"
        )
    return image


def _grey(image: "Image") -> tuple[NDArray[np.float64], bool]:
    """Give brightness (or opacity, if there is any transparency), and whether it is opacity."""
    if image.mode in ("RGBA", "LA", "PA") or "transparency" in image.info:
        opacity = np.asarray(image.convert("RGBA"))[..., 3]
        if opacity.min() < 128:
            return opacity.astype(np.float64), True
    if image.mode not in ("I", "F", "I;16", "I;16B", "I;16L"):
        image = image.convert("L")
    grey = np.asarray(image, dtype=np.float64)
    if not np.isfinite(grey).all():
        raise OutlineError("outline: the image holds numbers that are not finite")
    return grey, False


def _leaf(grey: NDArray[np.float64], is_mask: bool) -> NDArray[np.bool_]:
    """Tell the pixels of the leaf from the ground, which is what most of the border shows."""
    from skimage import filters

    low, high = grey.min(), grey.max()
    if low == high:
        raise OutlineError("outline: the image shows one grey only; no leaf stands out")
    is_bright = grey > (127.0 if is_mask else filters.threshold_otsu(grey))
    border = np.concatenate([is_bright[0], is_bright[-1], is_bright[:, 0], is_bright[:, -1]])
    return is_bright if is_mask or border.mean() <= 0.5 else ~is_bright


def _cleaned(leaf: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Take out small spots and close small holes."""
    sizes = _part_sizes(leaf)
    if len(sizes[1]) < 2:
        raise OutlineError("outline: no leaf stands out from the ground")
    least = LEAST_SHARE * sizes[1][1:].max()
    labels, areas = sizes
    kept = (areas >= least) & (np.arange(len(areas)) > 0)
    leaf = kept[labels]
    labels, areas = _part_sizes(~leaf)
    small = (areas < least) & (np.arange(len(areas)) > 0)
    return leaf | small[labels]


def _part_sizes(mask: NDArray[np.bool_]) -> tuple[Any, Any]:
    """Label the connected parts of a mask and count their pixels; label 0 is the rest."""
    from skimage import measure

    labels = measure.label(mask, connectivity=1)
    return labels, np.bincount(labels.ravel())
