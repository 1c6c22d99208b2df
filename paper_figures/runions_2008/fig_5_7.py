"""
Figure 5.7: growth by a table of stretch
========================================

Development of the first leaf by local-to-global growth, in seven pictures.
"""

from pathlib import Path

from ages import aged, draw_ages
from panels import output_of

from vasc.render import save

CONFIGS = ("arabidopsis-local-to-global",)
STEPS = (20, 41, 120, 226, 240, 290, 420)
"""A protrusion, the source at the tip, the midvein, the first lateral sources, lower halves, the
upper halves with the second loops, and the third with minor veins."""


def main(output: Path) -> None:
    """Draw the figure."""
    (name,) = CONFIGS
    leaves = aged(name, STEPS)
    rows = [leaves[:6], leaves[6:]]
    save(draw_ages(rows, (1.0, 0.5), (10.0, 20.0), "state"), output)


if __name__ == "__main__":
    main(output_of())
