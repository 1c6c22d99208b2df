"""The figure of a sweep: measures over its axes, or its leaves in a grid."""

from pathlib import Path

from vasc.sweeps.folder import SweepFolder

FIGURE = "figure.png"


def draw_sweep(folder: SweepFolder, output: Path) -> str:
    """Draw the figure that a sweep asks for.

    Parameters
    ----------
    folder : SweepFolder
        The folder, with its results.
    output : Path
        The picture; png, svg or pdf by its suffix. An old one is replaced.

    Returns
    -------
    str
        Why there is nothing to draw; empty if the picture is written.

    Raises
    ------
    OutputError
        If the suffix is none of these, or the folder does not exist.
    OSError
        If it cannot be written.
    """
    from vasc.render import save

    if folder.description()["sweep"]["figure"] == "pictures":
        from vasc.sweeps.grid import draw_grid

        figure = draw_grid(folder)
        reason = "no run has a leaf to be drawn"
    else:
        from vasc.sweeps.curves import draw_curves

        figure = draw_curves(folder)
        reason = "no measure is a number, or no key has several values"
    if figure is None:
        return reason
    save(figure, output)
    return ""
