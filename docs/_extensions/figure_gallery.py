"""How the gallery runs the scripts of ``paper_figures`` and finds what they draw."""

import re
from pathlib import Path
from typing import Any

from sphinx_gallery.scrapers import figure_rst


def by_number(name: str) -> list[int | str]:
    """Give what figures are sorted by: 4.9 comes before 4.10."""
    return [int(part) if part.isdigit() else part for part in re.findall(r"\d+|\D+", name)]


def output_option(settings: dict[str, Any], script: dict[str, Any]) -> list[str]:
    """Give the command line of a script: its figure goes where the page looks for it."""
    return ["-o", script["image_path_iterator"].next()]


def saved_figure(block: tuple, script: dict[str, Any], settings: dict[str, Any]) -> str:
    """Give the lines of the page that show the figure a script has saved."""
    paths = [path for path in script["image_path_iterator"].paths if Path(path).is_file()]
    return figure_rst(paths, settings["src_dir"])
