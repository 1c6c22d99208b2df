"""
Figure 4.19: a toothed leaf
===========================

A toothed leaf with a lobe; sequences of tertiary veins off the secondaries.
"""

from pathlib import Path

from leaves import draw_leaves
from panels import grown_leaf, output_of

from vasc.render import save

CONFIGS = ("toothed-lobed-leaf", "emergent-tertiary")


def main(output: Path) -> None:
    """Draw the figure."""
    states = [grown_leaf(name) for name in CONFIGS]
    save(draw_leaves(states, 2, ("a)", "b)")), output)


if __name__ == "__main__":
    main(output_of())
