"""
Figure 5.12: corners that stay
==============================

The final pattern of the first leaf when segments are halved, not corners cut.
"""

from pathlib import Path

from ages import aged, draw_ages
from panels import output_of

from vasc.render import save

CONFIGS = ("arabidopsis-first-leaf",)


def main(output: Path) -> None:
    """Draw the figure."""
    (name,) = CONFIGS
    leaves = aged(name, overrides=[(("refinement",), {"kind": "subdivision"})])
    save(draw_ages([leaves], (1.0,), (50.0,), "width"), output)


if __name__ == "__main__":
    main(output_of())
