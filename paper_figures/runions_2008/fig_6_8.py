"""
Figure 6.8: rise of the primordia
=================================

Stems whose primordia are ever farther apart in height, at 137.5 degrees.
"""

from pathlib import Path

from panels import output_of
from stems import draw_pairs, grown_pairs

from vasc.render import save

CONFIGS = (
    "stem-golden-5-8",
    "stem-golden-3-5-r115",
    "stem-golden-2-3-r115",
    "stem-golden-1-1-r115",
)
WORDS = (
    "(5, 8), H = 10 D",
    "(3, 5), H = 23 D",
    "(2, 3), H = 33 D",
    "(1, 1), H = 96 D",
)
"""What veins connect, and what is varied."""
N_PRIMORDIA = (36, 26, 20, 12)
"""Enough to see the pattern."""


def main(output: Path) -> None:
    """Draw the figure."""
    save(draw_pairs(grown_pairs(CONFIGS, WORDS, N_PRIMORDIA)), output)


if __name__ == "__main__":
    main(output_of())
