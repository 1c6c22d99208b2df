"""
Figure 3.2: two attraction points
=================================

The scalar field E, its directions and the branches of two attraction points.
"""

from pathlib import Path

import numpy as np
from fields import field_figure
from panels import output_of

from vasc.render import save

POINTS = np.array([[-28.0, 70.0], [28.0, 70.0]])


def main(output: Path) -> None:
    """Draw the figure."""
    save(field_figure(POINTS), output)


if __name__ == "__main__":
    main(output_of())
