"""
Figure 6.7: plastochrons
========================

Two stems that differ in their plastochron alone, unrolled.
"""

from pathlib import Path

from panels import output_of
from stems import draw_pairs, grown_stem

from vasc.render import save

CONFIGS = ("stem-golden-3-5-r50",)
PLASTOCHRONS = (1, 20)
N_PRIMORDIA = 28


def main(output: Path) -> None:
    """Draw the figure."""
    (name,) = CONFIGS
    stems = [
        (
            f"plastochron of {steps} step{'s' if steps > 1 else ''}",
            grown_stem(
                name, f"placement.plastochron={steps}", f"placement.primordia={N_PRIMORDIA}"
            ),
        )
        for steps in PLASTOCHRONS
    ]
    save(draw_pairs(stems, sizes=(2.6, 0.6), height=2.6), output)


if __name__ == "__main__":
    main(output_of())
