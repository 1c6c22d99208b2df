"""
Figure 6.10: the Lucas angle
============================

Ever thinner stems at the Lucas angle of 99.5 degrees.
"""

from pathlib import Path

from panels import output_of
from stems import draw_pairs, grown_pairs

from vasc.render import save

CONFIGS = (
    "stem-lucas-7-11",
    "stem-lucas-4-7",
    "stem-lucas-3-4",
    "stem-lucas-1-3",
    "stem-lucas-1-1",
)
WORDS = (
    "(7, 11), R = 180 D",
    "(4, 7), R = 115 D",
    "(3, 4), R = 50 D",
    "(1, 3), R = 25 D",
    "(1, 1), R = 12 D",
)
"""What veins connect, and what is varied."""
N_PRIMORDIA = (46, 34, 28, 24, 18)
"""Enough to see the pattern."""


def main(output: Path) -> None:
    """Draw the figure."""
    save(draw_pairs(grown_pairs(CONFIGS, WORDS, N_PRIMORDIA)), output)


if __name__ == "__main__":
    main(output_of())
