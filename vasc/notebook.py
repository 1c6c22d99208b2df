"""How objects show themselves in a notebook: a few facts and a small picture, in HTML."""

import base64
import html
import io
from collections.abc import Callable, Mapping, Sequence

import numpy as np

from vasc.arrays import Ids, Points

SIDE = 1.8
"""Longer side of a picture, in inches of a screen, which has 96 pixels there."""
DPI = 192
"""Twice that, so that screens of high resolution show fine veins."""
VEIN, BLADE, MARGIN = "#1f3d1c", "#dcebd0", "#6f9463"
WIDEST, FINEST = 1.2, 0.25
"""Width of the veins of a network of few segments, and of many, in pt."""


def card(title: str, facts: Mapping[str, Callable[[], object]], picture: Callable[[], str]) -> str:
    """Give a title, a table of facts, and a picture, as HTML.

    A notebook shows an object in whatever state it is, so that nothing here fails: a fact
    or a picture that cannot be had, as of a file that is closed, is left out.

    Parameters
    ----------
    title : str
        Stands above.
    facts : mapping of str to callable
        What gives each fact, by its name.
    picture : callable
        Gives a picture as HTML, empty for none.

    Returns
    -------
    str
    """
    rows = []
    for name, fact in facts.items():
        value = _tried(fact)
        if value is not None:
            shown = f"{value:,}" if isinstance(value, int) else f"{value}"
            rows.append(f"<tr><th>{html.escape(name)}</th><td>{html.escape(shown)}</td></tr>")
    drawn = _tried(picture) or ""
    return (
        f"<div><b>{html.escape(title)}</b>"
        f'<div style="display:flex;flex-wrap:wrap;align-items:flex-start;gap:1em">{drawn}'
        f"<table>{''.join(rows)}</table></div></div>"
    )


def picture_of(positions: Points, segments: Ids, rings: Sequence[Points] = ()) -> str:
    """Give a small picture of veins as an ``img`` element that holds it.

    Parameters
    ----------
    positions : ndarray of shape (n, d), float64
        Where the nodes are; of a stem in space, the side view.
    segments : ndarray of shape (m, 2), int32
        Rows of the two nodes of each segment; there may be none.
    rings : sequence of ndarray of shape (k, 2), float64
        The outline.

    Returns
    -------
    str
        Empty where there is nothing to draw.
    """
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    places = positions[:, [0, -1]]
    everything = np.concatenate([places, *rings])
    if not np.isfinite(everything).all() or len(everything) < 2:
        return ""
    low, high = everything.min(axis=0), everything.max(axis=0)
    margin = 0.03 * max(float((high - low).max()), 1e-9)
    low, high = low - margin, high + margin
    inches = np.maximum(SIDE * (high - low) / (high - low).max(), 0.3)
    figure = Figure(figsize=(float(inches[0]), float(inches[1])))
    FigureCanvasAgg(figure)
    axes = figure.add_axes((0.0, 0.0, 1.0, 1.0))
    axes.set_axis_off()
    axes.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), aspect="equal")
    for ring in rings:
        axes.fill(*ring.T, facecolor=BLADE, edgecolor=MARGIN, linewidth=0.6)
    # one line with gaps: a thousand times faster than a line a segment
    lines = np.full((len(segments), 3, 2), np.nan)
    lines[:, :2] = places[segments]
    width = float(np.clip(40.0 / np.sqrt(max(len(segments), 1)), FINEST, WIDEST))
    axes.plot(*lines.reshape(-1, 2).T, color=VEIN, linewidth=width)
    picture = io.BytesIO()
    figure.savefig(picture, format="png", dpi=DPI, metadata={"Software": None})
    text = base64.b64encode(picture.getvalue()).decode("ascii")
    width = round(96 * float(inches[0]))
    style = f'style="width:{width}px;max-width:100%;height:auto"'
    return f'<img alt="veins" {style} src="data:image/png;base64,{text}">'


def _tried(ask: Callable[[], object]) -> object:
    """Give an answer, None where there is none."""
    try:
        return ask()
    except Exception:
        return None
