"""
Figure 6.9: radius of the stem
==============================

Ever thinner stems, at 137.5 degrees.
"""

from pathlib import Path

from panels import output_of
from stems import draw_pairs, grown_pairs

from vasc.render import save

CONFIGS = (
    "stem-golden-5-8",
    "stem-golden-3-5-r50",
    "stem-golden-2-3-r35",
    "stem-golden-1-2",
    "stem-golden-1-1-r12",
)
WORDS = (
    "(5, 8), R = 115 D",
    "(3, 5), R = 50 D",
    "(2, 3), R = 35 D",
    "predominantly (1, 2), R = 16 D",
    "(1, 1), R = 12 D",
)
"""What veins connect, and what is varied."""
N_PRIMORDIA = (36, 28, 26, 24, 18)
"""Enough to see the pattern."""


def main(output: Path) -> None:
    """Draw the figure."""
    save(draw_pairs(grown_pairs(CONFIGS, WORDS, N_PRIMORDIA)), output)


if __name__ == "__main__":
    main(output_of())
