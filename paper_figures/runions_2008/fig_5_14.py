"""
Figure 5.14: a mature leaf, blind ends
======================================

A mature leaf with blindly terminating veins.
"""

from pathlib import Path

from ages import aged, draw_ages
from panels import output_of

from vasc.render import save

CONFIGS = ("mature-areoles-blind",)


def main(output: Path) -> None:
    """Draw the figure."""
    (name,) = CONFIGS
    save(draw_ages([aged(name)], (1.0,), (100.0,), "width"), output)


if __name__ == "__main__":
    main(output_of())
