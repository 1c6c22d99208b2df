"""
Figure 5.10: a first leaf of Arabidopsis
========================================

How the veins of the first leaf of Arabidopsis develop, in thirteen pictures.
"""

from pathlib import Path

from ages import aged, draw_ages
from panels import output_of

from vasc.render import save

CONFIGS = ("arabidopsis-first-leaf",)
ROWS = ((12, 95, 104, 122, 136), (146, 158, 192, 208, 222), (280, 370, 470))
SCALES = (1.0, 1.0, 0.4)
"""The bottom row is drawn at 0.4 of the scale of the others."""


def main(output: Path) -> None:
    """Draw the figure."""
    (name,) = CONFIGS
    leaves = aged(name, [step for row in ROWS for step in row])
    left = iter(leaves)
    rows = [[next(left) for _ in row] for row in ROWS]
    save(draw_ages(rows, SCALES, (10.0, 10.0, 25.0), "state"), output)


if __name__ == "__main__":
    main(output_of())
