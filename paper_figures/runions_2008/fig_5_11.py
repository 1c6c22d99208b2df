"""
Figure 5.11: the final pattern
==============================

The final pattern of the first leaf, and with corners cut at a lower threshold.
"""

from pathlib import Path

from ages import aged, draw_ages
from panels import output_of

from vasc.config import parse_override
from vasc.render import save

CONFIGS = ("arabidopsis-first-leaf",)
LOWER = "refinement.threshold=1.8"


def main(output: Path) -> None:
    """Draw the figure."""
    (name,) = CONFIGS
    leaves = aged(name) + aged(name, overrides=[parse_override(LOWER)])
    save(draw_ages([leaves], (1.0,), (50.0,), "width"), output)


if __name__ == "__main__":
    main(output_of())
