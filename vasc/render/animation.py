"""Films of a growing leaf: mp4 or gif."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vasc.analysis.run_widths import widths_of
from vasc.analysis.widths import WidthParameters
from vasc.errors import OutputError, VascError, writing
from vasc.render.files import node_widths, open_run
from vasc.render.leaf import draw_leaf, fitted_widths, narrowest_of, view_of
from vasc.render.saving import checked_output
from vasc.render.styles import DPI, INK, SOURCE_STATE_COLORS, TISSUE_COLOR_CHOICES, LeafStyle
from vasc.render.tissue_files import chosen_color, tissue_figures
from vasc.render.tissue_style import TissueStyle

if TYPE_CHECKING:
    from matplotlib.figure import Figure
    from PIL.Image import Image as Picture

    from vasc.timeline import Timeline

FILM_SUFFIXES = (".mp4", ".gif")
N_COLORS = 128
"""Colours of a gif, besides those of marks."""
MARKS = (
    INK,
    LeafStyle.background,
    LeafStyle.blade,
    TissueStyle.source,
    TissueStyle.sink,
    TissueStyle.arrow,
    *SOURCE_STATE_COLORS.values(),
)
"""Colours that a gif has as they are: of text, paper and blade, and of small marks."""
N_SAMPLES = 12
"""Pictures of a film from which the colours of all are taken."""
Pixels = NDArray[np.uint8]
"""A picture, shape (height, width, 3)."""


@dataclass(frozen=True)
class Film:
    """How a film is made.

    Parameters
    ----------
    n_pictures : int
        Pictures to spread over the run.
    pictures_per_second : int
        Speed.
    pixels : int
        Longer side of the film.
    rest : float
        How long the last picture stays, in seconds.
    """

    n_pictures: int = 120
    pictures_per_second: int = 20
    pixels: int = 960
    rest: float = 1.5


def animate(
    run: str | Path | Timeline,
    output: str | Path,
    *,
    every: int | None = None,
    color: str | None = None,
    widths: WidthParameters | None = None,
    sources: bool = False,
    scale_bar: bool = True,
    style: LeafStyle | None = None,
    film: Film | None = None,
    progress: Callable[[int, int], None] | None = None,
) -> Path:
    """Write a film of a recorded leaf or tissue, seen at the scale of the last blade.

    Parameters
    ----------
    run : path or Timeline
        The recorded run.
    output : path
        The film; mp4 or gif by its suffix. An old one is replaced.
    every : int, optional
        Draw every so many steps; ``film.n_pictures`` spread evenly if left out.
    color, sources, scale_bar, style
        See :func:`vasc.render.render`.
    widths : WidthParameters, optional
        The widths of the run's config if left out. Radii left open are fitted
        to the last step and hold for the whole film.
    film : Film, optional
        Length, speed and size.
    progress : callable, optional
        Told after each picture how many are drawn, and of how many.

    Returns
    -------
    Path
        The file written.

    Raises
    ------
    OutputError
        If the suffix is none of these, the folder does not exist, or an mp4 is
        asked for without the extra ``video``.
    VascError
        If ``color`` is none of the choices, ``every`` is below 1, or the run is no leaf's.
    TimelineError
        If ``run`` is not a timeline.
    """
    output = checked_output(output, FILM_SUFFIXES)
    film = Film() if film is None else film
    style = LeafStyle() if style is None else style
    if every is not None and every < 1:
        raise VascError(f"every: {every} is below 1")
    write = _write_mp4 if output.suffix.lower() == ".mp4" else _write_gif
    with open_run(run) as timeline:
        if timeline.dimensions == 3:
            raise VascError(f"{timeline.path}: films are made of leaves; draw it with vasc render")
        color = chosen_color(timeline, color)
        steps = chosen_steps(timeline.last_step, film.n_pictures, every)
        side = film.pixels / DPI
        if color in TISSUE_COLOR_CHOICES:
            figures = tissue_figures(timeline, steps, color, scale_bar, side)
        else:
            asked = widths or widths_of(timeline.config)
            look = LeafLook(color, asked, sources, scale_bar, style, side)
            figures = _leaf_figures(timeline, steps, look)
        with writing(output):
            write(_told(map(_pixels, figures), len(steps), progress), output, film)
    return output


class LeafLook(NamedTuple):
    """How all leaves of a film are drawn: see :func:`vasc.render.draw_leaf`."""

    color: str
    widths: WidthParameters
    sources: bool
    scale_bar: bool
    style: LeafStyle
    side: float
    """Longer side of the film, in inches."""


def _leaf_figures(timeline: Timeline, steps: list[int], look: LeafLook) -> Iterator[Figure]:
    """Draw leaves one after the other, at the scale and with the widths of the last."""
    last = timeline.frame(-1)
    narrowest = narrowest_of(last, look.color)
    view = view_of(last.blade, look.style, side=look.side, narrowest=narrowest)
    stretched = node_widths(timeline, look.widths, steps)
    settled = fitted_widths(last, look.widths, look.style, view, stretched.get(last.step))
    for step in steps:
        yield draw_leaf(
            timeline.frame(step),
            color=look.color,
            widths=settled,
            node_widths=stretched.get(step),
            asked_widths=look.widths,
            sources=look.sources,
            scale_bar=look.scale_bar,
            units=timeline.units,
            style=look.style,
            view=view,
            last_step=last.step,
        )


def chosen_steps(last: int, n_pictures: int, every: int | None = None) -> list[int]:
    """Choose the steps to draw: the first, the last, and an even spread between.

    Parameters
    ----------
    last : int
        The last recorded step.
    n_pictures : int
        Steps to choose, if ``every`` is left out.
    every : int, optional
        Distance between steps.

    Returns
    -------
    list of int
        Ascending; fewer than ``n_pictures`` if there are not so many.

    Examples
    --------
    >>> chosen_steps(10, 4)
    [0, 3, 7, 10]
    >>> chosen_steps(10, 4, every=4)
    [0, 4, 8, 10]
    """
    if every is not None:
        return sorted({*range(0, last + 1, every), last})
    return np.unique(np.rint(np.linspace(0, last, max(n_pictures, 2))).astype(int)).tolist()


def _told(
    pictures: Iterator[Pixels], n_pictures: int, progress: Callable[[int, int], None] | None
) -> Iterator[Pixels]:
    """Pass pictures on, and tell after each how many there are."""
    for count, picture in enumerate(pictures, start=1):
        yield picture
        if progress is not None:
            progress(count, n_pictures)


def _pixels(figure: Figure) -> Pixels:
    """Draw a figure; width and height are cut to even numbers, as films need them."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg

    figure.set_dpi(DPI)
    canvas = FigureCanvasAgg(figure)
    canvas.draw()
    picture = np.asarray(canvas.buffer_rgba())[:, :, :3]
    return np.ascontiguousarray(picture[: len(picture) // 2 * 2, : picture.shape[1] // 2 * 2])


def _write_mp4(pictures: Iterator[Pixels], output: Path, film: Film) -> None:
    """Encode pictures as H.264, which every player and browser shows."""
    try:
        import imageio_ffmpeg
    except ModuleNotFoundError as error:
        raise OutputError(
            f'{output}: mp4 needs imageio-ffmpeg: pip install "vasc[video]", or write a gif'
        ) from error
    first = next(pictures)
    unfinished = output.with_name(f".{output.stem}.unfinished.mp4")
    writer = imageio_ffmpeg.write_frames(
        str(unfinished),
        (first.shape[1], first.shape[0]),
        fps=film.pictures_per_second,
        codec="libx264",
        quality=8,
        macro_block_size=2,
        # one thread and no dates, so that equal runs give equal films
        output_params=["-threads", "1", "-fflags", "+bitexact", "-flags:v", "+bitexact"],
    )
    writer.send(None)
    try:
        picture = first
        writer.send(picture)
        for picture in pictures:
            writer.send(picture)
        for _ in range(round(film.rest * film.pictures_per_second)):
            writer.send(picture)
        writer.close()
        unfinished.replace(output)
    finally:
        writer.close()
        unfinished.unlink(missing_ok=True)


def _write_gif(pictures: Iterator[Pixels], output: Path, film: Film) -> None:
    """Write pictures as a gif that repeats."""
    from PIL import Image

    # a byte a pixel at once: all pictures are there before the colours of all are known
    small = [_reduced(image, _colors_of(image)) for image in map(Image.fromarray, pictures)]
    chosen = np.unique(np.linspace(0, len(small) - 1, N_SAMPLES).round().astype(int)).tolist()
    sample = np.concatenate([np.asarray(small[row].convert("RGB")) for row in chosen])
    # one palette, or colours would change from picture to picture
    colors = _colors_of(Image.fromarray(sample))
    small = [_reduced(picture.convert("RGB"), colors) for picture in small]
    pause = 1000 // film.pictures_per_second
    pauses = [pause] * (len(small) - 1) + [pause + round(1000 * film.rest)]
    unfinished = output.with_name(f".{output.stem}.unfinished.gif")
    try:
        small[0].save(unfinished, save_all=True, append_images=small[1:], duration=pauses, loop=0)
        unfinished.replace(output)
    finally:
        unfinished.unlink(missing_ok=True)


def _colors_of(picture: Picture) -> list[int]:
    """Choose the colours of a gif for a picture, as a palette: those of marks, and others."""
    from PIL import Image

    chosen = picture.quantize(N_COLORS, dither=Image.Dither.NONE)
    # where there are many shades of another colour, few pixels of a mark get none of their own
    marks = [channel for color in MARKS for channel in bytes.fromhex(color[1:])]
    return [*marks, *(chosen.getpalette() or [])[: 3 * N_COLORS]]


def _reduced(picture: Picture, colors: list[int]) -> Picture:
    """Give a picture in those of the colours that are nearest to its own."""
    from PIL import Image

    # Pillow looks for colours in steps of four, from below: white would become a light gray
    coarse = Image.new("P", (1, 1))
    coarse.putpalette([channel & ~3 for channel in colors])
    found = picture.quantize(palette=coarse, dither=Image.Dither.NONE)
    found.putpalette(colors)
    return found
