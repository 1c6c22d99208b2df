"""
Figure 3.3: three attraction points
===================================

The scalar field E, its directions and the branches of three attraction points.
"""

from pathlib import Path

import numpy as np
from fields import field_figure
from panels import output_of

from vasc.render import save

POINTS = np.array([[-34.0, 62.0], [16.0, 84.0], [40.0, 58.0]])


def main(output: Path) -> None:
    """Draw the figure."""
    save(field_figure(POINTS), output)


if __name__ == "__main__":
    main(output_of())
