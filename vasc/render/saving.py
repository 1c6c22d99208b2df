"""Pictures in files: png, svg and pdf, the same bytes for the same picture."""

from __future__ import annotations

import io
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from vasc.errors import OutputError, writing
from vasc.render.styles import DPI
from vasc.whole_files import refuse_special, write_whole

if TYPE_CHECKING:
    from matplotlib.figure import Figure

PICTURE_SUFFIXES = (".png", ".svg", ".pdf")
# what a user's matplotlibrc might change in a picture
_SETTINGS: Any = {
    "svg.hashsalt": "vasc",
    "svg.fonttype": "path",
    "font.family": "DejaVu Sans",
    "savefig.bbox": None,
    "savefig.transparent": False,
    "savefig.facecolor": "auto",
}
# no dates, no versions: equal runs give equal files
_METADATA: dict[str, dict[str, None]] = {
    ".png": {"Software": None},
    ".svg": {"Date": None, "Creator": None},
    ".pdf": {"CreationDate": None, "Creator": None, "Producer": None},
}


def save(figure: Figure, output: str | Path) -> None:
    """Write a figure as png, svg or pdf, without a date: equal figures give equal bytes.

    Parameters
    ----------
    figure : Figure
        What to write.
    output : path
        Where to; its suffix says as what.

    Raises
    ------
    OutputError
        If the suffix is none of these, the folder does not exist, or the system refuses; an
        old picture is then as it was.
    """
    from matplotlib import rc_context

    output = checked_output(output, PICTURE_SUFFIXES)
    kind = output.suffix.lower()
    picture = io.BytesIO()
    with rc_context(_SETTINGS):
        figure.savefig(picture, format=kind[1:], dpi=DPI, metadata=_METADATA[kind])
    with writing(output):
        write_whole(output, picture.getvalue())


def checked_output(output: str | Path, suffixes: Sequence[str]) -> Path:
    """Give a path that a picture can be written to.

    Parameters
    ----------
    output : path
        Where a picture is to go.
    suffixes : sequence of str
        What it may end in.

    Returns
    -------
    Path

    Raises
    ------
    OutputError
        If the suffix is none of these, or the folder does not exist.
    """
    path = Path(output)
    if path.suffix.lower() not in suffixes:
        raise OutputError(f"{path}: suffix {path.suffix!r} is not one of {', '.join(suffixes)}")
    if not path.parent.is_dir():
        raise OutputError(f"{path}: folder {path.parent} does not exist")
    refuse_special(path)
    return path
