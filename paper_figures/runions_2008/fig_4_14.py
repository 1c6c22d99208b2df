"""
Figure 4.14: parameters of venation
===================================

What the kill distance, the number of darts and slow growth do to a pattern.
"""

from pathlib import Path

from leaves import draw_leaves
from panels import grown_leaf, output_of

from vasc.render import save

CONFIGS = (
    *(f"param-kill-distance-{letter}" for letter in "abcde"),
    *(f"param-darts-{letter}" for letter in "fgh"),
    "slow-marginal",
)
"""The panels a to i, in this order."""


def main(output: Path) -> None:
    """Draw the figure."""
    states = [grown_leaf(name) for name in CONFIGS]
    save(draw_leaves(states, 5, [f"{letter})" for letter in "abcdefghi"]), output)


if __name__ == "__main__":
    main(output_of())
