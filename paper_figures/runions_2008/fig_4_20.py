"""
Figure 4.20: an orchid tree and a grass
=======================================

A leaf of the orchid tree, Bauhinia, and a segment of a grass leaf.
"""

from pathlib import Path

from leaves import draw_in_line
from panels import grown_leaf, output_of

from vasc.render import save

CONFIGS = ("orchid-leaf", "grass-leaf")


def main(output: Path) -> None:
    """Draw the figure."""
    states = [grown_leaf(name) for name in CONFIGS]
    save(draw_in_line(states, ("a)", "b)")), output)


if __name__ == "__main__":
    main(output_of())
