"""
Figure 4.15: a ginkgo
=====================

A leaf of Ginkgo biloba.
"""

from pathlib import Path

from leaves import draw_leaves
from panels import grown_leaf, output_of

from vasc.render import save

CONFIGS = ("ginkgo-leaf",)


def main(output: Path) -> None:
    """Draw the figure."""
    states = [grown_leaf(name) for name in CONFIGS]
    save(draw_leaves(states, 1), output)


if __name__ == "__main__":
    main(output_of())
