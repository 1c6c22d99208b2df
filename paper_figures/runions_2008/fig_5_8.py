"""
Figure 5.8: the mesophyll event
===============================

The pattern of local-to-global growth before and after the mesophyll event.
"""

from pathlib import Path

from ages import aged, draw_ages
from panels import output_of

from vasc.render import save

CONFIGS = ("arabidopsis-local-to-global",)
STEPS = (479, 616)
"""The last step before the event, and the last of all."""


def main(output: Path) -> None:
    """Draw the figure."""
    (name,) = CONFIGS
    save(draw_ages([aged(name, STEPS)], (1.0,), (50.0,), "width"), output)


if __name__ == "__main__":
    main(output_of())
